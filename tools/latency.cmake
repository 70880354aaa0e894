# The parts of `swiftlet latency`.
swiftlet_add_library(swiftlet_latency
  SOURCES latency_command.cpp latency/latency_picture.cpp latency/latency_table.cpp latency/timing_report.cpp
  LINK swiftlet_workers swiftlet_mapping
  LINK_PRIVATE swiftlet_daemon swiftlet_publish swiftlet_lcm_types swiftlet_outputs nlohmann_json::nlohmann_json
    spdlog::spdlog)
