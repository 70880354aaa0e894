# Sets SWIFTLET_BUILDS_PYTHON and, where that is true, finds pybind11 and Debian's own Python, whose modules lie where
# the package puts ours (Debian: pybind11-dev, python3-dev, python3-numpy).
set(SWIFTLET_BUILDS_PYTHON ${SWIFTLET_BUILD_PYTHON})
if(SWIFTLET_BUILD_PYTHON STREQUAL AUTO AND (CMAKE_CROSSCOMPILING OR SWIFTLET_SANITIZE))
  set(SWIFTLET_BUILDS_PYTHON OFF)  # a plain Python loads no sanitized module
endif()
if(SWIFTLET_BUILDS_PYTHON)
  if(SWIFTLET_BUILD_PYTHON STREQUAL AUTO)
    set(need QUIET)
  else()
    set(need REQUIRED)
  endif()
  if(NOT DEFINED Python_EXECUTABLE AND EXISTS /usr/bin/python3)
    set(Python_EXECUTABLE /usr/bin/python3)
  endif()
  set(PYBIND11_NOPYTHON ON)  # its own search takes the first Python on the PATH
  find_package(pybind11 2.10 CONFIG ${need})
  find_package(Python 3.11 ${need} COMPONENTS Interpreter Development.Module NumPy)
  set(SWIFTLET_BUILDS_PYTHON OFF)
  if(pybind11_FOUND AND Python_FOUND)
    set(SWIFTLET_BUILDS_PYTHON ON)
  endif()
  message(STATUS "Python's module: ${SWIFTLET_BUILDS_PYTHON}")
endif()
