# SPDX-License-Identifier: MIT
# SPDX-FileCopyrightText: 2026 The swiftlet authors
#
# find_package(swiftlet_messages): the target swiftlet_messages::swiftlet_messages, the C++ headers of swiftlet's LCM types
# with LCM itself; swiftlet_messages_LCM_DIR has the .lcm files, swiftlet_messages_JAR the Java types where installed.
get_filename_component(swiftlet_messages_prefix "${CMAKE_CURRENT_LIST_DIR}/../../.." ABSOLUTE)

# LCM of Debian 12 brings no package file for CMake.
find_path(LCM_INCLUDE_DIR lcm/lcm-cpp.hpp DOC "LCM's headers (Debian: liblcm-dev)")
find_library(LCM_LIBRARY lcm DOC "LCM's library (Debian: liblcm-dev)")
if(NOT LCM_INCLUDE_DIR OR NOT LCM_LIBRARY)
  set(swiftlet_messages_FOUND FALSE)
  set(swiftlet_messages_NOT_FOUND_MESSAGE "LCM is missing: install liblcm-dev, or set LCM_INCLUDE_DIR and LCM_LIBRARY")
  return()
endif()

if(NOT TARGET swiftlet_messages::swiftlet_messages)
  add_library(swiftlet_messages::swiftlet_messages INTERFACE IMPORTED)
  target_include_directories(swiftlet_messages::swiftlet_messages INTERFACE
    "${swiftlet_messages_prefix}/include" "${LCM_INCLUDE_DIR}")
  target_link_libraries(swiftlet_messages::swiftlet_messages INTERFACE "${LCM_LIBRARY}")
endif()
set(swiftlet_messages_LCM_DIR "${swiftlet_messages_prefix}/share/swiftlet/lcm")
set(swiftlet_messages_JAR "${swiftlet_messages_prefix}/share/swiftlet/swiftlet-messages.jar")
if(NOT EXISTS "${swiftlet_messages_JAR}")
  unset(swiftlet_messages_JAR)
endif()
