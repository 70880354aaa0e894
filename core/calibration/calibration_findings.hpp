// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <array>
#include <optional>
#include <string>

#include "core/calibration/calibration_scan.hpp"
#include "core/calibration/joint_problem.hpp"
#include "core/geometry/angle.hpp"
#include "core/sensing/sensor_model.hpp"

namespace swiftlet {

/// The result of a calibration for one setting of the sensor model.
struct CalibrationFinding {
  enum class Verdict {
    kNotObservable,  ///< for `reason`
    kAsIs,           ///< the present value agrees within two standard deviations
    kNegligible,     ///< it differs, but too little to matter
    kLearnt,         ///< it differs, but the frontend estimates it in each run: better left alone
    kMatters,        ///< it differs enough to be seen in a map
  };
  std::string setting;  ///< in the section [sensor] of a configuration file
  std::string meaning;
  std::string unit;
  double present = 0.0;  ///< the value used in the run
  double value = 0.0;    ///< meaningful unless not observable
  double sigma = 0.0;    ///< its standard deviation, likewise
  Verdict verdict = Verdict::kNotObservable;
  std::string reason;
};
using CalibrationFindings = std::array<CalibrationFinding, kSystematicErrors>;

struct CalibrationFindingsTuning {
  double min_path_m = 10.0;
  double min_turns_rad = 4.0 * kPi;
  double min_duration_s = 60.0;
  std::size_t min_returns = 300;
  double significant_sigmas = 2.0;
  /// A greater standard deviation is no estimate; in the order of SystematicError.
  std::array<double, kSystematicErrors> max_sigma{0.03, 0.02, 0.03, radians(0.5), 0.02, radians(0.1)};
  /// A smaller difference is not seen in a map.
  std::array<double, kSystematicErrors> negligible{0.01, 0.005, 0.01, radians(0.1), 0.005, radians(0.02)};
};

/// Why a run with so little motion calibrates nothing; nullopt where it may.
[[nodiscard]] std::optional<std::string> why_hopeless(const MotionSummary& motion,
                                                      const CalibrationFindingsTuning& tuning = {});

/// `sensor`: the model used in the run; `estimate` is relative to its range age, and to no calibration of the
/// odometry.
[[nodiscard]] CalibrationFindings judge_estimate(const JointEstimate& estimate, const MotionSummary& motion,
                                                 const SensorModel& sensor,
                                                 const CalibrationFindingsTuning& tuning = {});
/// All not observable, for that reason.
[[nodiscard]] CalibrationFindings nothing_observable(const std::string& reason, const SensorModel& sensor);

/// The sensor model with the values that matter replaced.
[[nodiscard]] SensorModel calibrated(const CalibrationFindings& findings, SensorModel sensor);

}  // namespace swiftlet
