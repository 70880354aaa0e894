// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include "core/sensing/keyframe.hpp"
#include "core/sensing/range_sample.hpp"

namespace swiftlet {

/// Uncertainty that the keyframes claim for their motion, independent from metre to metre.
struct DeadReckoningNoise {
  double floor_m = 0.002;
  double per_metre_m = 0.03;
  double floor_rad = 0.002;
  double per_metre_rad = 0.02;
};

/// The plainest frontend there is, to feed a backend under test: takes dead reckoning as it is, has no walls,
/// makes a keyframe every 0.5 m or 30 degrees and where a segment starts.
class DeadReckoningFrontend {
 public:
  explicit DeadReckoningFrontend(const DeadReckoningNoise& noise = {}) : noise_(noise) {}

  FrontendStep process(const RangeSample& sample);

 private:
  void make_keyframe(FrontendStep& step);

  DeadReckoningNoise noise_;
  bool started_ = false;
  KeyframeId newest_{};
  Pose2 T_odom_keyframe_;
  StoreyId storey_{};
  FixedVector<Pose2, kMaxKeyframeWindow> T_local_keyframe_;
};

}  // namespace swiftlet
