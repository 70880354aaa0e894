// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <array>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "core/backend/backend.hpp"
#include "core/base/result.hpp"
#include "core/calibration/systematic_prior.hpp"
#include "core/evaluation/consistency.hpp"
#include "core/evaluation/known_place_error.hpp"
#include "core/evaluation/trajectory_error.hpp"
#include "core/frontend/frontend.hpp"
#include "core/mapping/map_builder.hpp"
#include "daemon/workers/pruned_scans.hpp"
#include "daemon/workers/run_timing.hpp"
#include "firmware_link/sample/sample_source.hpp"

namespace swiftlet {

/// What was published of its confidence, against the truth.
struct RunConsistency {
  std::array<std::optional<ConsistencyAt>, kConsistencyDistancesM.size()> at{};
  AlarmCounts alarms;
};

/// Where the vehicle was when somebody asked to mark the place: at the sample of that stamp.
struct MarkedPlace {
  HostTime stamp{};
  std::string name;  ///< without control characters, commas and quotes
};

/// A finished run, as seen by whoever writes it down. The references must outlive it.
struct RunView {
  const Backend& backend;
  const MapBuilder& map;
  const InputReport& input;
  const FrontendCounters& frontend;
  RunTiming timing;
  std::vector<StampedPose> truth;  ///< T_world_body in order of time; empty where nobody knows it
  std::string input_uri;
  SensorModel sensor;                             ///< as used: with the configuration's overrides
  std::optional<InputCalibration> calibration{};  ///< by the input itself, where one was made
  std::vector<MendedOdometry> mended{};           ///< where the backend's dead reckoning is not as reported
  const PrunedScans* pruned = nullptr;            ///< where the backend may have pruned scans
  std::optional<KnownPlaceError> known_places{};  ///< of the poses published, where somebody kept them
  std::optional<RunConsistency> consistency{};    ///< likewise
  std::vector<MarkedPlace> places{};
  bool has_plan = false;        ///< a picture of the walls alone is wanted, too
  double peak_memory_mb = 0.0;  ///< of the program up to the end of the run, before anything was written
};

/// Visits every scan in order as the trajectory files have it: dead reckoning as reported. Errors: as
/// PrunedScans::for_each_scan().
[[nodiscard]] Status for_each_scan(const RunView& run,
                                   const std::function<void(const TrajectoryPoint&)>& visit);

/// Error of the path before correction, as published at the time, and after correction, over the scans whose
/// stamp the truth knows.
struct RunError {
  TrajectoryError odometry;
  TrajectoryError live;
  TrajectoryError corrected;
};
/// nullopt when the truth knows none of the scans.
[[nodiscard]] std::optional<RunError> run_error(const RunView& run);

/// map.pgm and map.yaml of the first storey; of the others map_storey1.pgm and so on.
[[nodiscard]] Status write_map_files(const std::filesystem::path& directory, const MapBuilder& map);

/// The names of the files that write_run_outputs() writes of this run, in that order: trajectories (the true
/// one where it is known), marked places if there are any, map and pictures of each storey (plan.png where it
/// is wanted), at last report.json, which lists them.
[[nodiscard]] std::vector<std::string> output_names(const RunView& run);

struct WrittenOutputs {
  std::vector<std::string> files;    ///< output_names()
  bool replaced = false;             ///< files of an earlier run
  std::vector<std::string> removed;  ///< those of an earlier run that this one does not have
};
/// Writes the outputs into the directory, which is created where missing. Files of other names stay, except
/// those that an earlier run's report.json there lists as its own. Each file is complete or not
/// there. Trajectories, places, map and pictures are written although one of them cannot be, the report only
/// after all of them. Error: the first one's.
[[nodiscard]] Result<WrittenOutputs> write_run_outputs(const std::filesystem::path& directory,
                                                       const RunView& run);
/// One line on what became of an earlier run's files; nullopt where there were none.
[[nodiscard]] std::optional<std::string> replacement_note(const std::filesystem::path& directory,
                                                          const WrittenOutputs& outputs);

}  // namespace swiftlet
