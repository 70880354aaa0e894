# Included: the library of --version, whose source is written anew where the checkout has another commit. As a script
# (-P): writes that source.
if(CMAKE_SCRIPT_MODE_FILE)
  execute_process(COMMAND git describe --always --dirty --abbrev=12 "--exclude=*"
    WORKING_DIRECTORY ${CHECKOUT} OUTPUT_VARIABLE COMMIT ERROR_QUIET OUTPUT_STRIP_TRAILING_WHITESPACE)
  if(NOT COMMIT OR NOT EXISTS ${CHECKOUT}/.git)  # an unpacked archive
    set(COMMIT unknown)
  endif()
  configure_file(${CHECKOUT}/daemon/version.cpp.in ${SOURCE} @ONLY)
  return()
endif()

find_package(PkgConfig REQUIRED)
pkg_check_modules(VERSION_LCM QUIET lcm)
file(STRINGS ${CHOLMOD_INCLUDE_DIR}/cholmod_core.h cholmod REGEX "define CHOLMOD_(MAIN|SUB|SUBSUB)_VERSION [0-9]+")
string(REGEX MATCHALL "[0-9]+" cholmod "${cholmod}")
list(JOIN cholmod . cholmod)
set(libraries "${CMAKE_CXX_COMPILER_ID} ${CMAKE_CXX_COMPILER_VERSION} with Eigen ${Eigen3_VERSION}, CHOLMOD ${cholmod}, LCM \
${VERSION_LCM_VERSION}, libusb ${LIBUSB_VERSION}, libpng ${PNG_VERSION_STRING}, zlib ${ZLIB_VERSION_STRING}, spdlog \
${spdlog_VERSION}, CLI11 ${CLI11_VERSION}, toml++ ${tomlplusplus_VERSION}")

set(source ${CMAKE_CURRENT_BINARY_DIR}/version.cpp)
add_custom_target(swiftlet_commit BYPRODUCTS ${source} VERBATIM
  COMMAND ${CMAKE_COMMAND} -D CHECKOUT=${PROJECT_SOURCE_DIR} -D SOURCE=${source} -D VERSION=${PROJECT_VERSION}
    -D "LIBRARIES=${libraries}" -P ${CMAKE_CURRENT_LIST_FILE})
swiftlet_add_library(swiftlet_version SOURCES ${source})
set_target_properties(swiftlet_version PROPERTIES DISABLE_PRECOMPILE_HEADERS ON)  # links nothing
add_dependencies(swiftlet_version swiftlet_commit)
