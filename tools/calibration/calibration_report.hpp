// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "core/calibration/calibration_findings.hpp"
#include "core/calibration/calibration_scan.hpp"

namespace swiftlet {

/// How well the returns held out of the final refinement fit the walls of other traversals.
struct CalibrationCheck {
  double held_out_before_m = 0.0;  ///< with the settings as they were
  double held_out_after_m = 0.0;   ///< with what matters set

  /// The figure differs by some percent between runs that are equally good. More than a tenth worse is a map
  /// in which walls lie double.
  [[nodiscard]] bool is_worse() const { return held_out_after_m > 1.1 * held_out_before_m; }
};

/// All results of a calibration.
struct CalibrationReport {
  std::string input_uri;
  std::size_t samples = 0;
  MotionSummary motion;
  CalibrationFindings findings;
  std::optional<CalibrationCheck> check;  ///< nothing where nothing changed
};

/// For people.
[[nodiscard]] std::string calibration_text(const CalibrationReport& report);
/// For programs; ends with a newline.
[[nodiscard]] std::string calibration_json(const CalibrationReport& report);
/// A configuration file that sets what matters, unless the check shows that it does harm; the rest stands in
/// comments.
[[nodiscard]] std::string calibration_toml(const CalibrationReport& report);

}  // namespace swiftlet
