// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "core/base/time.hpp"
#include "firmware_link/simulation/random.hpp"

namespace swiftlet {

/// How air and control tilt the vehicle, besides its accelerations: standard deviations of roll and pitch.
struct TiltModel {
  double calm_rad = 0.0;
  double gust_rad = 0.0;
  double gust_share = 0.13;  ///< of the time
};

struct Tilt {
  double roll_rad = 0.0;
  double pitch_rad = 0.0;  ///< nose down positive
};

/// Noise source: "tilt". One thread at a time; step() allocates nothing.
class SimulatedTilt {
 public:
  SimulatedTilt(const TiltModel& model, std::uint64_t seed);

  /// One kFlightStep; `by_motion`: what the acceleration asks for.
  void step(const Tilt& by_motion);
  [[nodiscard]] const Tilt& now() const { return recent_[newest_]; }
  /// So long ago, at most a second; a time ahead counts as now.
  [[nodiscard]] const Tilt& before(Duration age) const;

 private:
  TiltModel model_;
  NoiseSource noise_;
  bool is_gust_ = false;
  double sigma_rad_;  // follows calm and gust smoothly
  Tilt shaken_;       // in standard deviations
  std::vector<Tilt> recent_;
  std::size_t newest_ = 0;
};

/// What a reading becomes that was taken for a level beam: longer, or the floor where the beam meets it
/// before.
[[nodiscard]] std::optional<double> tilted_range_m(std::optional<double> level_m, double bearing_rad,
                                                   const Tilt& tilt, double height_m);

}  // namespace swiftlet
