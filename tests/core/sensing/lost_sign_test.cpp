// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "core/sensing/lost_sign.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstring>
#include <string>
#include <vector>

#include "tests/support/pose_near.hpp"
#include "tests/support/random_geometry.hpp"
#include "tests/support/text_room.hpp"

namespace swiftlet {
namespace {

using std::chrono::milliseconds;

constexpr double kBlockM = 0.5;
const double kMaxRangeM = SensorModel::carmen_laser().max_range_m;

/// Nine beams over the half circle in front.
BeamLayout front_beams() {
  BeamLayout beams{.count = 9};
  for (std::size_t i = 0; i < beams.count; ++i)
    beams.bearing_rad[i] = (static_cast<double>(i) - 4.0) * kPi / 8.0;
  return beams;
}

/// 25 m long, with doors into rooms; 's' is the start.
TextRoom corridor_with_doors() {
  return {{"####################################################",  //
           "#.......##....######.....##......#####...#####....##",  //
           "#.......##....######.....##......#####...#####....##",  //
           "###..#######..########..######..######...#####..####",  //
           "#..................................................#",  //
           "#..s...............................................#",  //
           "#..................................................#",  //
           "######..#########..#########..####..########..######",  //
           "#....#......####...########.........########......##",  //
           "#....#......####...########.........########......##",  //
           "####################################################"},
          kBlockM};
}

/// The same from every place: its ends are out of range.
TextRoom featureless_corridor() {
  const std::string wall(100, '#');
  const std::string left(45, '.');
  const std::string right(54, '.');
  return {{wall, left + "." + right, left + "s" + right, left + "." + right, wall}, kBlockM};
}

/// Drives to and fro along x, with a little noise in ranges and odometry.
class Drive {
 public:
  explicit Drive(TextRoom room)
      : room_(std::move(room)), T_world_(room_.place('s').x_m, room_.place('s').y_m, 0.0) {
    measure();
  }

  /// Speeds up and brakes with 1 m/s^2. `left`: that much to the left with each metre.
  void go(double way_m, double left = 0.0) {
    const double sign = way_m < 0.0 ? -1.0 : 1.0;
    const double length_m = std::abs(way_m);
    for (double done_m = 0.0; done_m < length_m;) {
      const double speed_m_per_s = std::min({0.5, std::sqrt(2.0 * done_m) + 0.1,  //
                                             std::sqrt(2.0 * (length_m - done_m)) + 0.02});
      const double step_m = std::min(0.1 * speed_m_per_s, length_m - done_m);
      done_m += step_m;
      if (sign < 0.0) reversed_m_ += step_m;
      T_world_ = T_world_ * Pose2(sign * step_m, left * step_m, random_.normal(0.002));
      steps_.push_back(
          {sign * step_m * (1.0 + random_.normal(0.02)), left * step_m, T_world_.yaw_rad() - yaw_before_});
      yaw_before_ = T_world_.yaw_rad();
      measure();
    }
  }
  /// Seven stretches in reverse, 5.2 m together.
  void to_and_fro() {
    for (const double way_m : {4.2, -0.9, 3.0, -0.4, 2.5, -1.2, 3.5, -0.5, 4.1, -0.8, 2.0, -0.7, 3.0, -0.7})
      go(way_m);
  }

  /// With steps as they are ...
  [[nodiscard]] std::vector<RangeSample> with_true_odometry() const { return with_odometry(1.0); }
  /// ... or with those in reverse reported as forward.
  [[nodiscard]] std::vector<RangeSample> with_lost_signs() const { return with_odometry(-1.0); }
  [[nodiscard]] double reversed_m() const { return reversed_m_; }

 private:
  TextRoom room_;
  Pose2 T_world_;
  double yaw_before_ = 0.0;
  double reversed_m_ = 0.0;
  test::RandomGeometry random_{7};
  BeamLayout beams_ = front_beams();
  std::vector<Pose2> steps_;
  std::vector<RangeSample> samples_;

  void measure() {
    RangeSample sample;
    sample.sequence = static_cast<std::uint32_t>(samples_.size());
    sample.measured_at = DeviceTime(sample.sequence * milliseconds(100));
    sample.stamp = HostTime(sample.sequence * milliseconds(100));
    sample.starts_segment = samples_.empty();
    sample.beam_count = beams_.count;
    for (std::size_t i = 0; i < beams_.count; ++i) {
      const auto range_m =
          room_.range_m(T_world_.position(), T_world_.yaw_rad() + beams_.bearing_rad[i], kMaxRangeM);
      sample.status[i] = range_m ? RangeStatus::kHit : RangeStatus::kNoReturn;
      if (range_m) sample.distance_m[i] = static_cast<float>(*range_m + random_.normal(0.01));
    }
    samples_.push_back(sample);
  }

  [[nodiscard]] std::vector<RangeSample> with_odometry(double sign_in_reverse) const {
    std::vector<RangeSample> out = samples_;
    for (std::size_t i = 1; i < out.size(); ++i) {
      const Pose2& step = steps_[i - 1];
      const double sign = step.x_m() < 0.0 ? sign_in_reverse : 1.0;
      out[i].T_odom_body = out[i - 1].T_odom_body * Pose2(sign * step.x_m(), step.y_m(), step.yaw_rad());
    }
    return out;
  }
};

struct Mending {
  std::vector<RangeSample> samples;
  std::vector<MendedOdometry> mended;
  double reversed_m = 0.0;
};

Mending mend(const std::vector<RangeSample>& samples, const LostSignTuning& tuning = {}) {
  LostSign signs(SensorModel::carmen_laser(), front_beams(), tuning);
  Mending out;
  const auto take_all = [&] {
    while (const auto sample = signs.take()) out.samples.push_back(*sample);
  };
  for (const RangeSample& sample : samples) {
    signs.add(sample);
    take_all();
  }
  signs.end();
  take_all();
  out.mended = signs.mended();
  out.reversed_m = signs.reversed_m();
  return out;
}

bool same_bytes(const std::vector<RangeSample>& a, const std::vector<RangeSample>& b) {
  return a.size() == b.size() && std::equal(a.begin(), a.end(), b.begin(), [](const auto& x, const auto& y) {
           return x.sequence == y.sequence && x.T_odom_body.vector() == y.T_odom_body.vector();
         });
}

TEST(LostSign, MendsReverseDrivingThatWasReportedAsForward) {
  Drive drive(corridor_with_doors());
  drive.to_and_fro();
  const std::vector<RangeSample> truth = drive.with_true_odometry();
  const Mending mending = mend(drive.with_lost_signs());
  EXPECT_NEAR(mending.reversed_m, drive.reversed_m(), 0.3);
  ASSERT_EQ(mending.samples.size(), truth.size());
  for (std::size_t i = 0; i < truth.size(); ++i)
    ASSERT_TRUE(poses_near(mending.samples[i].T_odom_body, truth[i].T_odom_body, 0.15, 1e-9)) << i;
}

TEST(LostSign, ARunMayBeginInReverse) {
  Drive drive(corridor_with_doors());
  drive.go(-0.9);
  drive.to_and_fro();
  const std::vector<RangeSample> truth = drive.with_true_odometry();
  const Mending mending = mend(drive.with_lost_signs());
  EXPECT_NEAR(mending.reversed_m, drive.reversed_m(), 0.3);
  for (std::size_t i = 0; i < truth.size(); ++i)
    ASSERT_TRUE(poses_near(mending.samples[i].T_odom_body, truth[i].T_odom_body, 0.15, 1e-9)) << i;
}

TEST(LostSign, GivesBackWhatWasReported) {
  Drive drive(corridor_with_doors());
  drive.to_and_fro();
  const std::vector<RangeSample> reported = drive.with_lost_signs();
  const Mending mending = mend(reported);
  ASSERT_FALSE(mending.mended.empty());
  for (std::size_t i = 0; i < reported.size(); ++i)
    ASSERT_TRUE(poses_near(as_reported(mending.mended, reported[i].stamp, mending.samples[i].T_odom_body),
                           reported[i].T_odom_body, 1e-9, 1e-12))
        << i;
}

TEST(LostSign, IsRepeatable) {
  Drive drive(corridor_with_doors());
  drive.to_and_fro();
  const std::vector<RangeSample> reported = drive.with_lost_signs();
  EXPECT_TRUE(same_bytes(mend(reported).samples, mend(reported).samples));
}

TEST(LostSign, ChangesNothingWhereTheRangesSayNothing) {
  Drive drive(featureless_corridor());
  drive.to_and_fro();
  const std::vector<RangeSample> reported = drive.with_lost_signs();
  const Mending mending = mend(reported);
  EXPECT_TRUE(same_bytes(mending.samples, reported));
  EXPECT_TRUE(mending.mended.empty());
}

TEST(LostSign, ChangesNothingWhereStopsArePassedForward) {
  Drive drive(corridor_with_doors());
  for (int i = 0; i < 22; ++i) drive.go(1.0);
  const std::vector<RangeSample> reported = drive.with_lost_signs();
  EXPECT_TRUE(same_bytes(mend(reported).samples, reported));
}

TEST(LostSign, ChangesNothingAfterFewerThanThreeStretches) {
  Drive drive(corridor_with_doors());
  for (const double way_m : {4.2, -0.9, 3.0, -1.2, 2.5}) drive.go(way_m);
  const std::vector<RangeSample> reported = drive.with_lost_signs();
  EXPECT_TRUE(same_bytes(mend(reported).samples, reported));
}

TEST(LostSign, ForATrialOneClearStretchIsEnough) {
  Drive drive(corridor_with_doors());
  for (const double way_m : {4.2, -2.8, 2.5}) drive.go(way_m);
  const Mending mending = mend(drive.with_lost_signs(), LostSignTuning::for_a_trial());
  EXPECT_NEAR(mending.reversed_m, drive.reversed_m(), 0.2);
  EXPECT_EQ(prior_cost(mending.mended), 7.0);  // one stretch

  Drive forward(corridor_with_doors());
  for (int i = 0; i < 22; ++i) forward.go(1.0);
  EXPECT_TRUE(mend(forward.with_lost_signs(), LostSignTuning::for_a_trial()).mended.empty());
}

TEST(LostSign, WhatGoesSidewaysInReverseStays) {
  Drive drive(corridor_with_doors());
  for (const double way_m : {4.2, 3.0, 2.5, 3.5, 4.1}) {
    drive.go(way_m);
    drive.go(-1.2, 0.35);
    drive.go(1.2, -0.35);
  }
  const std::vector<RangeSample> truth = drive.with_true_odometry();
  const Mending mending = mend(drive.with_lost_signs());
  ASSERT_GT(mending.reversed_m, 0.8 * drive.reversed_m());
  for (std::size_t i = 0; i < truth.size(); ++i)
    ASSERT_TRUE(poses_near(mending.samples[i].T_odom_body, truth[i].T_odom_body, 0.3, 1e-9)) << i;
}

TEST(LostSign, StretchesThatGainNoMoreThanTheDoubtStayAsReported) {
  Drive drive(corridor_with_doors());
  drive.to_and_fro();
  const std::vector<RangeSample> reported = drive.with_lost_signs();
  const auto reversed_m = [&](double doubt) {
    return mend(reported, {.stretch_doubt = doubt, .min_evidence = -1e9}).reversed_m;
  };
  EXPECT_LT(reversed_m(60.0), 0.9 * drive.reversed_m());
  EXPECT_GT(reversed_m(60.0), 0.0);
  EXPECT_EQ(reversed_m(1e6), 0.0);
}

TEST(LostSign, EachChangeHasItsPrice) {
  const LostSignTuning tuning{.begin_cost = 5.0, .end_cost = 2.0};
  std::vector<MendedOdometry> mended;
  EXPECT_EQ(prior_cost(mended, tuning), 0.0);
  mended.push_back({HostTime(milliseconds(1)), {}, true});
  mended.push_back({HostTime(milliseconds(2)), {}, true});
  EXPECT_EQ(prior_cost(mended, tuning), 5.0);
  mended.push_back({HostTime(milliseconds(3)), {}, false});
  mended.push_back({HostTime(milliseconds(4)), {}, true});
  EXPECT_EQ(prior_cost(mended, tuning), 12.0);
}

TEST(LostSign, ABackwardStepShowsThatSignsAreReported) {
  Drive drive(corridor_with_doors());
  drive.to_and_fro();
  const std::vector<RangeSample> reported = drive.with_true_odometry();
  EXPECT_TRUE(same_bytes(mend(reported).samples, reported));

  std::vector<RangeSample> once = drive.with_lost_signs();
  for (std::size_t i = once.size() - 5; i < once.size(); ++i) once[i].T_odom_body = once[0].T_odom_body;
  EXPECT_TRUE(same_bytes(mend(once).samples, once));
}

TEST(LostSign, HoldsBackNoMoreThanItsLookAhead) {
  Drive drive(corridor_with_doors());
  drive.to_and_fro();
  const LostSignTuning tuning{.look_ahead = 50};
  LostSign signs(SensorModel::carmen_laser(), front_beams(), tuning);
  std::size_t held = 0;
  for (const RangeSample& sample : drive.with_lost_signs()) {
    signs.add(sample);
    ++held;
    while (signs.take()) --held;
    ASSERT_LE(held, tuning.look_ahead);
  }
  EXPECT_GT(signs.reversed_m(), 0.5);  // what was seen after the evidence was there
}

TEST(LostSign, AStepBetweenSegmentsIsLeftAlone) {
  Drive drive(corridor_with_doors());
  drive.to_and_fro();
  std::vector<RangeSample> reported = drive.with_lost_signs();
  const std::size_t reset = reported.size() / 2;
  const Pose2 T_new_old(-3.0, 8.0, 0.0);
  reported[reset].starts_segment = true;
  for (std::size_t i = reset; i < reported.size(); ++i)
    reported[i].T_odom_body = T_new_old * reported[i].T_odom_body;
  const Mending mending = mend(reported);
  EXPECT_NEAR(mending.reversed_m, drive.reversed_m(), 0.5);
  EXPECT_TRUE(poses_near(between(mending.samples[reset - 1].T_odom_body, mending.samples[reset].T_odom_body),
                         between(reported[reset - 1].T_odom_body, reported[reset].T_odom_body), 1e-9, 1e-12));
}

}  // namespace
}  // namespace swiftlet
