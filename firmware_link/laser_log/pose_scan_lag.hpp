// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace swiftlet {

/// How far a scanner turned from one scan to the next, counter-clockwise: the turn by which both agree best,
/// to a fraction of `step_rad`, the angle between readings. nullopt if they do not agree, e.g. because too
/// much is out of range, or if it turned by 40 degrees or more. Both scans have the same number of readings,
/// in metres.
[[nodiscard]] std::optional<double> turned_rad(std::span<const float> before, std::span<const float> now,
                                               double step_rad);

/// Detects whether the poses that a laser log has beside its scans run ahead of them by a line, as in logs
/// whose recorder took the newest pose for a scan that had waited. Scan and pose turn together: the turns of
/// the scans are compared with those of the poses beside them and one line before. One thread.
class PoseScanLag {
 public:
  /// The next line: its readings and its pose's yaw. Allocates.
  void add(std::span<const float> distances_m, double yaw_rad, double step_rad);
  /// The scans before and after are not neighbours.
  void interrupt() { lines_ = 0; }

  /// Whether enough turns were seen and those of the poses one line before fit clearly better.
  [[nodiscard]] bool runs_a_line_ahead() const;
  /// Mean difference of the turns of scans and poses, clipped; 0 before the first turn.
  [[nodiscard]] double difference_rad() const { return mean(sum_rad_); }
  [[nodiscard]] double difference_to_line_before_rad() const { return mean(sum_before_rad_); }

 private:
  [[nodiscard]] double mean(double sum) const {
    return turns_ == 0 ? 0.0 : sum / static_cast<double>(turns_);
  }

  std::vector<float> distances_m_;  // of the line before
  double yaw_rad_ = 0.0;            // of its pose
  double turn_rad_ = 0.0;           // of its pose since the one before
  std::size_t lines_ = 0;           // in a row, as far as it matters
  std::size_t turns_ = 0;
  double sum_rad_ = 0.0;
  double sum_before_rad_ = 0.0;
};

}  // namespace swiftlet
