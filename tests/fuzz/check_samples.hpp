// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <cmath>
#include <cstdint>
#include <optional>

#include "core/base/check.hpp"
#include "core/sensing/range_sample.hpp"
#include "firmware_link/sample/sample_source.hpp"

namespace swiftlet {

/// What core relies on in every sample, whatever the vehicle sends.
inline void check_sample(const RangeSample& sample, const std::optional<RangeSample>& before) {
  SWIFTLET_CHECK(sample.sequence == (before ? before->sequence + 1 : 0), "samples are numbered from 0");
  SWIFTLET_CHECK(before || sample.starts_segment, "the first sample begins a segment");
  SWIFTLET_CHECK(!before || sample.starts_segment || sample.measured_at > before->measured_at,
                 "time goes on within a segment");
  const Pose2& pose = sample.T_odom_body;
  SWIFTLET_CHECK(std::isfinite(pose.x_m()) && std::isfinite(pose.y_m()) && std::isfinite(pose.yaw_rad()),
                 "dead reckoning is finite");
  SWIFTLET_CHECK(sample.beam_count <= kMaxBeams, "beams fit into the sample");
  for (std::size_t i = 0; i < sample.beam_count; ++i) {
    const float distance_m = sample.distance_m[i];
    const bool is_hit = sample.status[i] == RangeStatus::kHit;
    SWIFTLET_CHECK(is_hit ? std::isfinite(distance_m) && distance_m > 0.0F : distance_m == 0.0F,
                   "hits have a distance, others none");
  }
}

/// Takes what the source has to give, time-outs included, and checks it. The source must end.
inline void drain(SampleSource& source) {
  std::optional<RangeSample> before;
  for (;;) {
    const Result<ReceivedSample> received = source.next();
    if (!received && received.error().code == ErrorCode::kTimeout) continue;
    if (!received) break;
    check_sample(received->sample, before);
    before = received->sample;
  }
  SWIFTLET_CHECK(source.report().counters.samples == (before ? before->sequence + 1 : 0),
                 "the report counts the samples");
}

}  // namespace swiftlet
