// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "firmware_link/laser_log/pose_scan_lag.hpp"

#include <algorithm>
#include <cmath>

#include "core/geometry/angle.hpp"

namespace swiftlet {
namespace {

constexpr double kMaxTurnRad = radians(40.0);
constexpr float kMaxHitM = 20.0F;        // farther readings are no hits
constexpr float kMaxDifferenceM = 0.5F;  // larger differences count as this: another object was hit
constexpr double kAgreesM = 0.2;         // on average
constexpr std::size_t kMinReadings = 60;

constexpr double kMinTurnRad = 0.02;
constexpr double kMaxDifferenceRad = 0.1;
constexpr std::size_t kMinTurns = 100;
constexpr std::size_t kMaxTurns = 1000;  // are enough
constexpr double kClearlyBetter = 0.75;

/// Mean difference of the readings if the scanner turned by `steps` readings.
double disagreement_m(std::span<const float> before, std::span<const float> now, int steps) {
  const auto size = static_cast<int>(now.size());
  float sum_m = 0.0F;
  std::size_t count = 0;
  for (int i = std::max(0, -steps); i < std::min(size, size - steps); ++i) {
    const int same_direction = i + steps;
    const float a = before[static_cast<std::size_t>(same_direction)];
    const float b = now[static_cast<std::size_t>(i)];
    if (!(a < kMaxHitM && b < kMaxHitM)) continue;
    sum_m += std::min(std::abs(a - b), kMaxDifferenceM);
    ++count;
  }
  return count < kMinReadings ? kMaxDifferenceM : sum_m / static_cast<float>(count);
}

/// The minimum of the parabola through three equally spaced values, -0.5 to 0.5 steps from the middle one.
double lowest_between(double left, double middle, double right) {
  const double bend = left - 2.0 * middle + right;
  return bend > 0.0 ? std::clamp(0.5 * (left - right) / bend, -0.5, 0.5) : 0.0;
}

}  // namespace

std::optional<double> turned_rad(std::span<const float> before, std::span<const float> now, double step_rad) {
  const int widest = static_cast<int>(std::lround(kMaxTurnRad / step_rad));
  int best = -widest;
  double lowest_m = disagreement_m(before, now, best);
  for (int steps = -widest + 1; steps <= widest; ++steps) {
    const double cost_m = disagreement_m(before, now, steps);
    if (cost_m >= lowest_m) continue;
    best = steps;
    lowest_m = cost_m;
  }
  if (lowest_m > kAgreesM || std::abs(best) == widest) return std::nullopt;
  const double between =
      lowest_between(disagreement_m(before, now, best - 1), lowest_m, disagreement_m(before, now, best + 1));
  return (best + between) * step_rad;
}

void PoseScanLag::add(std::span<const float> distances_m, double yaw_rad, double step_rad) {
  const double turn_rad = wrap_angle(yaw_rad - yaw_rad_);
  const bool turns = std::max(std::abs(turn_rad), std::abs(turn_rad_)) > kMinTurnRad;
  if (lines_ >= 2 && turns && turns_ < kMaxTurns) {
    if (const std::optional<double> scan_turned_rad = turned_rad(distances_m_, distances_m, step_rad)) {
      ++turns_;
      sum_rad_ += std::min(std::abs(*scan_turned_rad - turn_rad), kMaxDifferenceRad);
      sum_before_rad_ += std::min(std::abs(*scan_turned_rad - turn_rad_), kMaxDifferenceRad);
    }
  }
  distances_m_.assign(distances_m.begin(), distances_m.end());
  yaw_rad_ = yaw_rad;
  turn_rad_ = turn_rad;
  ++lines_;
}

bool PoseScanLag::runs_a_line_ahead() const {
  return turns_ >= kMinTurns && sum_before_rad_ < kClearlyBetter * sum_rad_;
}

}  // namespace swiftlet
