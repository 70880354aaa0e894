// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/backend/backend.hpp"
#include "core/sensing/keyframe.hpp"

namespace swiftlet {

/// Steps as a frontend would deliver them, from a vehicle that flies a straight line along x through the
/// middle of a room of 12 m x 4 m (x from -6 to 6, y from -2 to 2), a keyframe every fifth sample. With
/// `drift_per_keyframe_rad` the frontend changes its mind about the whole window at every keyframe.
inline std::vector<FrontendStep> room_flight(int samples, double drift_per_keyframe_rad = 0.0) {
  constexpr int kSamplesPerKeyframe = 5;
  constexpr double kStepM = 0.1;
  std::vector<FrontendStep> steps;
  for (int i = 0; i < samples; ++i) {
    const double x = -5.0 + kStepM * i;
    FrontendStep step;
    step.sample.sequence = static_cast<std::uint32_t>(i);
    step.sample.stamp = HostTime(std::chrono::milliseconds(1'600'000'000'123LL + 100LL * i));
    step.sample.T_odom_body = Pose2(kStepM * i, 0.0, 0.0);
    step.T_dead_body = step.sample.T_odom_body;
    step.sample.starts_segment = i == 0;
    step.sample.beam_count = 4;
    const double to_front = 6.0 - x;
    const double to_back = x + 6.0;
    const double distances[] = {to_front, 2.0, to_back, 2.0};
    for (std::size_t beam = 0; beam < 4; ++beam) {
      const bool seen = distances[beam] <= 3.0;
      step.sample.distance_m[beam] = seen ? static_cast<float>(distances[beam]) : 0.0F;
      step.sample.status[beam] = seen ? RangeStatus::kHit : RangeStatus::kNoReturn;
    }
    const int keyframe = i / kSamplesPerKeyframe;
    const double bend_rad = drift_per_keyframe_rad * keyframe;
    const auto pose_at = [&](int sample) {
      const double s = kStepM * sample;
      return Pose2(s * std::cos(bend_rad), s * std::sin(bend_rad), bend_rad);
    };
    step.keyframe = static_cast<KeyframeId>(keyframe);
    step.T_local_body = pose_at(i);
    step.T_keyframe_body = Pose2(kStepM * (i % kSamplesPerKeyframe), 0.0, 0.0);
    step.has_keyframe = i % kSamplesPerKeyframe == 0;
    if (step.has_keyframe) {
      step.made.id = step.keyframe;
      step.made.starts_segment = i == 0;
      step.made.motion_covariance = {1e-4, 0.0, 0.0, 1e-4, 0.0, 1e-5};
      const int window = std::min(keyframe + 1, static_cast<int>(kMaxKeyframeWindow));
      for (int k = keyframe - window + 1; k <= keyframe; ++k)
        (void)step.made.T_local_keyframe.try_push_back(pose_at(k * kSamplesPerKeyframe));
      (void)step.made.landmarks.try_push_back({LandmarkId{0}, {-1.0, 2.0}, {1.0, 2.0}});
    }
    steps.push_back(step);
  }
  return steps;
}

inline BackendConfig without_loops() {
  BackendConfig config;
  config.close_loops = false;
  return config;
}

}  // namespace swiftlet
