// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/base/result.hpp"
#include "core/evaluation/known_place_error.hpp"
#include "daemon/outputs/run_outputs.hpp"
#include "firmware_link/sample/sample_source.hpp"

namespace swiftlet {

/// What `swiftlet eval --live` was asked to do.
struct LiveEvalCommand {
  std::string input;              ///< a recording or a simulation, which is mapped
  std::string truth_file;         ///< TUM; empty: the simulation's own or, of a recording, its final path
  std::string config_file;        ///< empty: the defaults
  std::optional<double> batch_s;  ///< travel time between moments at which a final pass ends the run
  bool calibrate = true;          ///< from the whole input, before it is mapped
};

/// What runs that end at some of the moments of a run, each with its final pass, make of its known places.
struct BatchError {
  std::size_t moments = 0;  ///< at known places, of those that were tried
  double rms_m = 0.0;
  double share_off = 0.0;       ///< beyond 0.3 m
  double live_rms_m = 0.0;      ///< of the poses published at these moments
  double live_share_off = 0.0;  ///< likewise
};

struct LiveEvaluation {
  std::string input;
  KnownPlaceError live;
  std::optional<BatchError> batch;
  RunConsistency consistency;
  std::vector<DoubtedPose> poses{};  ///< as published
  InputReport report{};              ///< of the input, with the notes of the run
};

/// Maps the input and holds the poses published on the way against the map that was published then, and their
/// covariances and states against the errors. Damage after usable samples is no error: it is in the report.
///
/// Errors: kNotFound, kInvalidInput: input, configuration or truth cannot be used, or the truth has no pose
/// within kStampTolerance of a published one. kDamaged: the truth is damaged.
[[nodiscard]] Result<LiveEvaluation> evaluate_live(const LiveEvalCommand& command);

[[nodiscard]] std::string live_evaluation_text(const LiveEvaluation& evaluation);
[[nodiscard]] std::string live_evaluation_json(const LiveEvaluation& evaluation);

}  // namespace swiftlet
