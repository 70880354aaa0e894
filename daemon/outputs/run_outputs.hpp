// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/backend/backend.hpp"
#include "core/base/result.hpp"
#include "core/calibration/systematic_prior.hpp"
#include "core/evaluation/known_place_error.hpp"
#include "core/evaluation/trajectory_error.hpp"
#include "core/frontend/frontend.hpp"
#include "core/mapping/map_builder.hpp"
#include "daemon/workers/pruned_scans.hpp"
#include "daemon/workers/run_timing.hpp"
#include "firmware_link/sample/sample_source.hpp"

namespace swiftlet {

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
  std::vector<MendedPositions> mended{};          ///< where the backend's dead reckoning is not as reported
  const PrunedScans* pruned = nullptr;            ///< where the backend may have pruned scans
  std::optional<KnownPlaceError> known_places{};  ///< of the poses published, where somebody kept them
  double peak_memory_mb = 0.0;  ///< of the program up to the end of the run, before anything was written
};

/// Error of the path before correction, as published at the time, and after correction, over the scans whose
/// stamp the truth knows.
struct RunError {
  TrajectoryError odometry;
  TrajectoryError live;
  TrajectoryError corrected;
};
/// nullopt when the truth knows none of the scans.
[[nodiscard]] std::optional<RunError> run_error(const RunView& run);

/// Writes map.png, map.pgm, map.yaml, trajectory.tum, odometry.tum, live.tum, report.json and, where the
/// truth is known, ground_truth.tum into the directory, which is created where missing. Each file is complete
/// or not there: the first that cannot be written ends it, those before it stay.
[[nodiscard]] Status write_run_outputs(const std::filesystem::path& directory, const RunView& run);

}  // namespace swiftlet
