# The Debian packages, by cpack -G DEB: swiftlet is what runs and what consumers build with, python3-swiftlet Python's
# module where it is built, swiftlet-doc the documents.
# tools/test-package makes and tries them.
set(package_dir ${CMAKE_CURRENT_LIST_DIR})
set(made_dir ${PROJECT_BINARY_DIR}/package)
set(SWIFTLET_PACKAGE_CONTACT "The swiftlet authors <maintainers@swiftlet.invalid>" CACHE STRING
  "Maintainer of the Debian packages, with an address")

# Where the service looks for them; below other prefixes docs/real_time.md says what to copy.
if(CMAKE_INSTALL_PREFIX STREQUAL "/usr")
  install(FILES ${PROJECT_SOURCE_DIR}/daemon/config/swiftletd.toml DESTINATION /etc/swiftlet COMPONENT swiftlet)
  install(FILES ${package_dir}/default/swiftletd DESTINATION /etc/default COMPONENT swiftlet)
endif()

set(changelog ${made_dir}/changelog.Debian)
configure_file(${package_dir}/changelog.in ${changelog} @ONLY)
execute_process(COMMAND gzip -9nf ${changelog} COMMAND_ERROR_IS_FATAL ANY)
file(READ ${PROJECT_SOURCE_DIR}/LICENSE LICENSE_TEXT)
string(REGEX REPLACE "^.*(Permission is.*)\n$" "\n\\1" LICENSE_TEXT "${LICENSE_TEXT}")
string(REPLACE "\n" "\n " LICENSE_TEXT "${LICENSE_TEXT}")
string(REPLACE "\n \n" "\n .\n" LICENSE_TEXT "${LICENSE_TEXT}")
string(REGEX REPLACE "^\n" "" LICENSE_TEXT "${LICENSE_TEXT}")
configure_file(${package_dir}/copyright.in ${made_dir}/copyright @ONLY)

set(components swiftlet doc)
if(SWIFTLET_BUILDS_PYTHON)
  list(APPEND components python)
endif()
set(package_of_swiftlet swiftlet)
set(package_of_doc swiftlet-doc)
set(package_of_python python3-swiftlet)
foreach(component IN LISTS components)
  set(package ${package_of_${component}})
  install(FILES ${changelog}.gz ${made_dir}/copyright DESTINATION share/doc/${package} COMPONENT ${component})
endforeach()

set(CPACK_GENERATOR DEB)
set(CPACK_SET_DESTDIR ON)  # for what stands in /etc
set(CPACK_STRIP_FILES ON)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS
  OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)
set(CPACK_COMPONENTS_ALL ${components})
set(CPACK_PACKAGE_CONTACT ${SWIFTLET_PACKAGE_CONTACT})
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_RELEASE 1)
set(CPACK_DEBIAN_PACKAGE_PRIORITY optional)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)

set(CPACK_DEBIAN_SWIFTLET_PACKAGE_NAME swiftlet)
set(CPACK_DEBIAN_SWIFTLET_PACKAGE_SECTION science)
set(CPACK_DEBIAN_SWIFTLET_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_SWIFTLET_PACKAGE_SUGGESTS
  "python3-swiftlet, swiftlet-doc, bash-completion, liblcm-bin, liblcm-dev, liblcm-java, udev")
set(CPACK_DEBIAN_SWIFTLET_PACKAGE_CONTROL_EXTRA
  "${package_dir}/conffiles;${package_dir}/postinst;${package_dir}/prerm;${package_dir}/postrm")
set(CPACK_COMPONENT_SWIFTLET_DESCRIPTION "swiftletd turns four range beams and flow odometry of a Crazyflie nano
quadrotor into a corrected path and a map while it flies, and publishes them
over LCM. swiftlet maps recordings and laser logs, shows the map in a browser,
checks dongle and vehicle, and simulates flights. The package has the message
types, too.")

# It is built for one version of Python, whose bytecode the scripts make and remove.
set(CPACK_DEBIAN_PYTHON_PACKAGE_NAME python3-swiftlet)
set(CPACK_DEBIAN_PYTHON_PACKAGE_SECTION python)
set(CPACK_DEBIAN_PYTHON_PACKAGE_SHLIBDEPS ON)
if(SWIFTLET_BUILDS_PYTHON)
  math(EXPR next_python_minor "${Python_VERSION_MINOR} + 1")
  set(CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS
    "python3 (>= 3.${Python_VERSION_MINOR}~), python3 (<< 3.${next_python_minor}), python3-numpy")
endif()
set(CPACK_DEBIAN_PYTHON_PACKAGE_SUGGESTS "swiftlet, swiftlet-doc")
set(CPACK_DEBIAN_PYTHON_PACKAGE_CONTROL_EXTRA "${package_dir}/python/postinst;${package_dir}/python/prerm")
set(CPACK_COMPONENT_PYTHON_DESCRIPTION "This package has the Python module swiftlet: it maps recordings and laser logs
into numpy arrays, and receives poses, map tiles and status from a running
swiftletd.")

set(CPACK_DEBIAN_DOC_PACKAGE_NAME swiftlet-doc)
set(CPACK_DEBIAN_DOC_PACKAGE_SECTION doc)
set(CPACK_DEBIAN_DOC_PACKAGE_ARCHITECTURE all)
set(CPACK_COMPONENT_DOC_DESCRIPTION "This package has the documents: how to fly with it,
settings, messages, accuracy, algorithm and architecture.")
include(CPack)
