// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <string>
#include <vector>

#include "core/backend/backend.hpp"
#include "firmware_link/sample/sample_source.hpp"

namespace swiftlet {

/// What frontend and backend make of a whole input, with nothing of the daemon around them.
struct CorrectedRun {
  std::vector<RangeSample> samples;
  std::vector<Pose2> T_map_body;   ///< one a sample
  std::vector<Tracking> tracking;  ///< one a sample, as it was then
  std::vector<StampedPose> truth;  ///< one a sample, where the input knows it
  BackendCounters counters;
  InputReport input;
};

/// Takes an input through frontend and backend, sample by sample and to the final pass.
CorrectedRun corrected_run(SampleSource& source);
/// Opens an input for it. Fails the running test where it cannot be opened; the run is empty then.
CorrectedRun corrected_run(const std::string& uri);

/// Root mean square error of the positions, aligned; one pose a sample. Precondition: the truth is known.
double error_m(const CorrectedRun& run, const std::vector<Pose2>& poses);
/// The same of the corrected poses.
inline double error_m(const CorrectedRun& run) { return error_m(run, run.T_map_body); }

/// The dead reckoning of each sample: what a run is corrected from.
std::vector<Pose2> dead_reckoned(const CorrectedRun& run);

}  // namespace swiftlet
