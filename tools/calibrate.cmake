# The parts of `swiftlet calibrate`.
swiftlet_add_library(swiftlet_calibrate
  SOURCES calibrate_command.cpp calibration/calibration_report.cpp calibration/calibration_rounds.cpp calibration/input_calibration.cpp
  LINK swiftlet_calibration swiftlet_run swiftlet_firmware_link
  LINK_PRIVATE swiftlet_outputs swiftlet_daemon swiftlet_tools nlohmann_json::nlohmann_json spdlog::spdlog)
