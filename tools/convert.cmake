# The parts of `swiftlet convert`.
swiftlet_add_library(swiftlet_convert
  SOURCES convert_command.cpp convert/mcap_run.cpp
  LINK swiftlet_outputs swiftlet_view
  LINK_PRIVATE swiftlet_lcm_types swiftlet_live swiftlet_map swiftlet_tools swiftlet_view_command spdlog::spdlog)
