// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <cstddef>
#include <limits>
#include <optional>
#include <vector>

#include "core/geometry/angle.hpp"
#include "core/sensing/sensor_model.hpp"

namespace swiftlet {

/// How the readings of a laser scan lie, counter-clockwise from the first.
struct ScanGeometry {
  std::size_t readings = 0;
  double start_rad = 0.0;
  double step_rad = 0.0;

  [[nodiscard]] double bearing_rad(std::size_t reading) const {
    return start_rad + static_cast<double>(reading) * step_rad;
  }
  /// Whether a further reading would lie on the first, or beyond.
  [[nodiscard]] bool is_full_circle() const {
    return (static_cast<double>(readings) + 0.5) * step_rad > 2.0 * kPi;
  }
  bool operator==(const ScanGeometry&) const = default;
};

/// Of a scan that tells only how many readings it has: those of the scanners that have so many (SICK's LMS
/// with 180 degrees by 1 and by 0.5, 100 by 0.25 and 270 by 0.5; Hokuyo's URG and UTM). nullopt: of none.
[[nodiscard]] std::optional<ScanGeometry> usual_geometry(std::size_t readings);

/// Sparse sensing as in the IROS 2022 paper: of `readings` takes `beam_count`: 0, k, 2k, .. with k = readings
/// / (beam_count - 1) in whole numbers, and the last one. Where this leaves more than one and a half k before
/// the last, all lie evenly instead. Precondition: 2 <= beam_count <= readings.
[[nodiscard]] std::vector<std::size_t> pick_beams(std::size_t readings, std::size_t beam_count);

inline constexpr std::size_t kNoReading = std::numeric_limits<std::size_t>::max();

/// For each beam the reading that lies nearest to it, kNoReading where none lies within half a step.
[[nodiscard]] std::vector<std::size_t> readings_along(const BeamLayout& beams, const ScanGeometry& geometry);

}  // namespace swiftlet
