# The parts of `swiftlet view`.
swiftlet_add_library(swiftlet_view_command
  SOURCES view_command.cpp view/mapped_recording.cpp
  LINK swiftlet_view
  LINK_PRIVATE swiftlet_calibrate swiftlet_live swiftlet_map swiftlet_publish spdlog::spdlog)
