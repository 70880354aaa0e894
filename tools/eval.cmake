# The files that trajectories are evaluated from.
swiftlet_add_library(swiftlet_eval_files
  SOURCES
    evaluation/common_time.cpp
    evaluation/number_rows.cpp
    evaluation/reference_kind.cpp
    evaluation/relations_file.cpp
    evaluation/tum_file.cpp
  LINK swiftlet_evaluation swiftlet_firmware_link
  LINK_PRIVATE spdlog::spdlog)

# The parts of `swiftlet eval`.
swiftlet_add_library(swiftlet_eval
  SOURCES
    eval_command.cpp
    evaluation/eval_report.cpp
    evaluation/evaluate.cpp
  LINK swiftlet_eval_files
  LINK_PRIVATE swiftlet_live swiftlet_outputs nlohmann_json::nlohmann_json spdlog::spdlog)
