// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "core/frontend/frontend.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <cstddef>
#include <set>
#include <vector>

#include "core/frontend/line_fit.hpp"
#include "core/geometry/angle.hpp"
#include "tests/core/frontend/room_drive.hpp"

namespace swiftlet {
namespace {

using test::drive_around;
using test::DriveErrors;
using test::RoomDrive;

struct RunOutcome {
  std::vector<FrontendStep> steps;
  FrontendCounters counters;
};

RunOutcome run(const RoomDrive& drive, const FrontendConfig& config = {},
               const BeamLayout& beams = BeamLayout::multiranger(),
               const SensorModel& sensor = SensorModel::crazyflie()) {
  Frontend frontend(config, sensor, beams);
  RunOutcome out;
  for (const RangeSample& sample : drive.samples) out.steps.push_back(frontend.process(sample));
  out.counters = frontend.counters();
  return out;
}

struct RelativeError {
  double position_m = 0.0;
  double yaw_rad = 0.0;
  RelativeError& operator+=(const RelativeError& other) {
    position_m += other.position_m;
    yaw_rad += other.yaw_rad;
    return *this;
  }
};

// Mean error of the pose `lag` samples later as seen from each sample.
RelativeError relative_error(const RoomDrive& drive, const std::vector<FrontendStep>& steps,
                             std::size_t lag) {
  RelativeError sum;
  const double count = static_cast<double>(steps.size() - lag);
  for (std::size_t i = 0; i + lag < steps.size(); ++i) {
    const Pose2 truth = between(drive.T_room_body[i], drive.T_room_body[i + lag]);
    const Pose2 error = between(truth, between(steps[i].T_local_body, steps[i + lag].T_local_body));
    sum += {std::hypot(error.x_m(), error.y_m()) / count, std::abs(error.yaw_rad()) / count};
  }
  return sum;
}

RoomDrive usual_drive(unsigned seed, const DriveErrors& errors = {}) {
  return drive_around(2, BeamLayout::multiranger(), SensorModel::crazyflie(), errors, seed);
}

TEST(Frontend, StartsAtTheOriginWithAKeyframe) {
  const RunOutcome out = run(usual_drive(1));
  const FrontendStep& first = out.steps.front();
  ASSERT_TRUE(first.has_keyframe);
  EXPECT_TRUE(first.made.starts_segment);
  EXPECT_EQ(first.keyframe, KeyframeId{0});
  EXPECT_EQ(first.T_local_body.vector(), Eigen::Vector3d::Zero());
  EXPECT_EQ(first.made.T_local_keyframe.size(), 1U);
}

TEST(Frontend, TakesTheCalibrationOutOfItsDeadReckoning) {
  SensorModel sensor = SensorModel::crazyflie();
  sensor.odometry_calibration = {.forward_scale = 1.25, .yaw_per_second_rad = 0.1};
  Frontend frontend({}, sensor, BeamLayout::multiranger());
  RangeSample sample;
  sample.starts_segment = true;
  static_cast<void>(frontend.process(sample));
  sample.starts_segment = false;
  sample.measured_at += std::chrono::milliseconds(100);
  sample.T_odom_body = Pose2(0.08, 0.0, 0.02);
  const Pose2 T_dead_body = frontend.process(sample).T_dead_body;
  EXPECT_NEAR(T_dead_body.x_m(), 0.1, 1e-12);
  EXPECT_NEAR(T_dead_body.yaw_rad(), 0.03, 1e-12);
}

TEST(Frontend, MakesAKeyframeAfterHalfAMetreOrThirtyDegrees) {
  const RunOutcome out = run(usual_drive(2, {0.0, 0.0}));
  std::uint32_t made = 0;
  Pose2 T_odom_keyframe;
  for (const FrontendStep& step : out.steps) {
    const Pose2 moved = between(T_odom_keyframe, step.sample.T_odom_body);
    const bool is_due = step.sample.starts_segment || std::hypot(moved.x_m(), moved.y_m()) >= 0.5 - 1e-9 ||
                        std::abs(moved.yaw_rad()) >= radians(30.0) - 1e-9;
    ASSERT_EQ(step.has_keyframe, is_due) << "at sample " << step.sample.sequence;
    if (!step.has_keyframe) continue;
    T_odom_keyframe = step.sample.T_odom_body;
    EXPECT_EQ(index_of(step.made.id), made++);
  }
  EXPECT_EQ(out.counters.keyframes, made);
}

TEST(Frontend, ReportsEveryStepFromItsNewestKeyframe) {
  const RunOutcome out = run(usual_drive(3));
  Pose2 T_local_keyframe;
  for (const FrontendStep& step : out.steps) {
    if (step.has_keyframe) {
      ASSERT_EQ(step.made.id, step.keyframe);
      ASSERT_EQ(step.T_keyframe_body.vector(), Eigen::Vector3d::Zero());
      T_local_keyframe = step.made.T_local_keyframe.back();
    }
    ASSERT_EQ(step.T_local_body.vector(), (T_local_keyframe * step.T_keyframe_body).vector());
  }
}

TEST(Frontend, KeepsItsWindowBounded) {
  FrontendConfig config;
  config.window_keyframes = 10;
  config.association_keyframes = 8;
  const RunOutcome out = run(usual_drive(4), config);
  for (const FrontendStep& step : out.steps) ASSERT_LE(step.made.T_local_keyframe.size(), 10U);
  EXPECT_EQ(out.counters.poses_retired, out.counters.keyframes - 10);
  EXPECT_GT(out.counters.landmarks_retired, 0U);
  EXPECT_EQ(out.counters.refused_full, 0U);
}

TEST(Frontend, IsBetterThanDeadReckoning) {
  FrontendConfig dead_reckoning;
  dead_reckoning.use_landmarks = false;
  RelativeError corrected;
  RelativeError dead_reckoned;
  for (unsigned seed = 1; seed <= 5; ++seed) {
    const RoomDrive drive = usual_drive(seed);
    corrected += relative_error(drive, run(drive).steps, 200);
    dead_reckoned += relative_error(drive, run(drive, dead_reckoning).steps, 200);
  }
  EXPECT_LT(corrected.position_m, 0.85 * dead_reckoned.position_m);
  EXPECT_LT(corrected.yaw_rad, 0.75 * dead_reckoned.yaw_rad);
}

TEST(Frontend, LearnsThatTheOdometryTurnsWithoutKnowingIt) {
  const BeamLayout beams = BeamLayout::multiranger();
  SensorModel drifting = SensorModel::crazyflie();
  drifting.odometry.drift_yaw_per_metre_rad = radians(2.0);
  const RoomDrive drive = drive_around(6, beams, drifting, {1.0, radians(2.0)}, 6);
  const double corrected_m = relative_error(drive, run(drive, {}, beams, drifting).steps, 200).position_m;
  const double uncorrected_m = relative_error(drive, run(drive).steps, 200).position_m;
  EXPECT_LT(corrected_m, 0.6 * uncorrected_m);
}

TEST(Frontend, LearnsNothingOfADriftWhereNoWallIsSeen) {
  constexpr double kDriftRadPerM = radians(2.0);
  BeamLayout beams{.count = 11};
  for (std::size_t i = 0; i < beams.count; ++i)
    beams.bearing_rad[i] = (static_cast<double>(i) - 5.0) * kPi / 10.0;
  SensorModel wheels = SensorModel::carmen_laser();
  const auto missed_rad_per_m = [&](double open_m) {  // in the second ten metres of a corridor
    const std::vector<test::RoomWall> walls{{{open_m, -1.0}, {open_m + 80.0, -1.0}},
                                            {{open_m, 1.0}, {open_m + 80.0, 1.0}}};
    const auto samples_to = [](double x_m) { return static_cast<std::size_t>(std::lround(x_m / 0.05)); };
    const std::vector<Pose2> steps(samples_to(open_m + 20.0), Pose2(0.05, 0.0, 0.0));
    double missed_rad = 0.0;
    for (unsigned seed = 1; seed <= 8; ++seed) {
      const RoomDrive drive =
          test::drive_along(walls, Pose2(), steps, beams, wheels, {0.3, kDriftRadPerM}, seed);
      const std::vector<FrontendStep> driven = run(drive, {}, beams, wheels).steps;
      const auto yaw_rad = [&](double x_m) { return driven[samples_to(x_m)].T_dead_body.yaw_rad(); };
      missed_rad += std::abs(wrap_angle(yaw_rad(open_m + 20.0) - yaw_rad(open_m + 10.0)));
    }
    return missed_rad / (8 * 10.0);
  };
  EXPECT_LT(missed_rad_per_m(10.0), 1.5 * missed_rad_per_m(0.0) + radians(0.1));
}

TEST(Frontend, ReportsTheWallsThatAreThere) {
  const RoomDrive drive = usual_drive(7, {0.2, 0.0});
  const std::vector<test::RoomWall> room = test::ring_of_corridors();
  std::size_t reported = 0;
  for (const FrontendStep& step : run(drive).steps) {
    if (!step.has_keyframe) continue;
    for (const LandmarkUpdate& wall : step.made.landmarks) {
      ++reported;
      const Pose2& T_room_body = drive.T_room_body[step.sample.sequence];
      double nearest_m = 1e9;
      for (const test::RoomWall& truth : room) {
        LineFit fit;
        fit.add(truth.start);
        fit.add(truth.end);
        const double start_m = std::abs(fit.line().distance_m(T_room_body * wall.start_keyframe));
        const double end_m = std::abs(fit.line().distance_m(T_room_body * wall.end_keyframe));
        nearest_m = std::min(nearest_m, std::max(start_m, end_m));
      }
      EXPECT_LT(nearest_m, 0.3) << "wall " << index_of(wall.id) << " at sample " << step.sample.sequence;
    }
  }
  EXPECT_GT(reported, 100U);
}

TEST(Frontend, KeepsOneWallOneLandmarkAsLongAsItIsInSight) {
  const RunOutcome out =
      run(drive_around(1, BeamLayout::multiranger(), SensorModel::crazyflie(), {0.2, 0.0}, 8));
  std::set<LandmarkId> seen_in_first_corridor;
  for (std::size_t i = 0; i < 230; ++i)
    if (out.steps[i].has_keyframe)
      for (const LandmarkUpdate& wall : out.steps[i].made.landmarks) seen_in_first_corridor.insert(wall.id);
  EXPECT_EQ(seen_in_first_corridor.size(), 2U);
}

TEST(Frontend, DeadReckonsWithoutLandmarks) {
  FrontendConfig config;
  config.use_landmarks = false;
  const RoomDrive drive = usual_drive(9);
  for (const FrontendStep& step : run(drive, config).steps) {
    const Pose2 error = between(step.sample.T_odom_body, step.T_local_body);
    ASSERT_NEAR(error.x_m(), 0.0, 1e-9);
    ASSERT_NEAR(error.y_m(), 0.0, 1e-9);
    ASSERT_NEAR(error.yaw_rad(), 0.0, 1e-9);
    ASSERT_TRUE(step.made.landmarks.empty());
  }
}

TEST(Frontend, TakesNoMotionFromAJumpOfTheDeadReckoning) {
  RoomDrive drive = usual_drive(10);
  constexpr std::size_t kJump = 400;
  for (std::size_t i = kJump; i < drive.samples.size(); ++i)
    drive.samples[i].T_odom_body = Pose2(50.0, -30.0, 2.0) * drive.samples[i].T_odom_body;
  drive.samples[kJump].starts_segment = true;
  const RunOutcome out = run(drive);
  const FrontendStep& before = out.steps[kJump - 1];
  const FrontendStep& after = out.steps[kJump];
  ASSERT_TRUE(after.has_keyframe);
  EXPECT_TRUE(after.made.starts_segment);
  EXPECT_NEAR(after.T_local_body.x_m(), before.T_local_body.x_m(), 1e-6);
  EXPECT_NEAR(after.T_local_body.y_m(), before.T_local_body.y_m(), 1e-6);
  EXPECT_GT(after.made.motion_covariance.xx, 1e3);
  EXPECT_GT(after.made.motion_covariance.yaw_yaw, 1e1);
  const std::vector<FrontendStep> later(out.steps.begin() + kJump, out.steps.end());
  RoomDrive rest;
  rest.T_room_body.assign(drive.T_room_body.begin() + kJump, drive.T_room_body.end());
  EXPECT_LT(relative_error(rest, later, 100).position_m, 0.3);
}

TEST(Frontend, GuessesTheWayAcrossASilenceThatTheDeadReckoningOutlived) {
  RoomDrive drive = usual_drive(10);
  constexpr std::size_t kSilence = 400;
  constexpr std::size_t kSamplesLost = 30;
  drive.samples.erase(drive.samples.begin() + kSilence, drive.samples.begin() + kSilence + kSamplesLost);
  drive.samples[kSilence].starts_segment = true;
  drive.samples[kSilence].odometry_ran_on = true;
  const RunOutcome out = run(drive);
  const FrontendStep& before = out.steps[kSilence - 1];
  const FrontendStep& after = out.steps[kSilence];
  EXPECT_TRUE(after.made.starts_segment);
  EXPECT_TRUE(after.made.odometry_ran_on);
  const Pose2 step = between(before.T_local_body, after.T_local_body);
  const Pose2 flown = between(before.sample.T_odom_body, after.sample.T_odom_body);
  EXPECT_NEAR(step.x_m(), flown.x_m(), 1e-6);
  EXPECT_NEAR(step.y_m(), flown.y_m(), 1e-6);
  EXPECT_LT(after.made.motion_covariance.xx, 1.0);
  EXPECT_GT(after.made.motion_covariance.xx, 2.0 * before.made.motion_covariance.xx);
}

/// Walls are seen on both sides of the sample, and none of them on both.
void expect_other_walls_from(std::size_t sample, const RunOutcome& out) {
  std::set<LandmarkId> before;
  std::set<LandmarkId> after;
  for (std::size_t i = 0; i < 230; ++i)
    if (out.steps[i].has_keyframe)
      for (const LandmarkUpdate& wall : out.steps[i].made.landmarks)
        (i < sample ? before : after).insert(wall.id);
  EXPECT_FALSE(before.empty());
  EXPECT_FALSE(after.empty());
  for (const LandmarkId id : after) EXPECT_EQ(before.count(id), 0U);
}

TEST(Frontend, TakesNoWallsAcrossAJump) {
  RoomDrive drive = usual_drive(11, {0.2, 0.0});
  constexpr std::size_t kJump = 120;
  drive.samples[kJump].starts_segment = true;
  const RunOutcome out = run(drive);
  expect_other_walls_from(kJump, out);
}

TEST(Frontend, WallsFromBeforeAJumpTellNoAxis) {
  RoomDrive drive = usual_drive(11, {0.2, 0.0});
  constexpr std::ptrdiff_t kJump = 250;    // where it would begin to turn,
  constexpr std::ptrdiff_t kSkipped = 20;  // by 82 of 90 degrees
  constexpr std::ptrdiff_t kLater = kJump + 60;
  drive.samples.erase(drive.samples.begin() + kJump, drive.samples.begin() + kJump + kSkipped);
  drive.T_room_body.erase(drive.T_room_body.begin() + kJump, drive.T_room_body.begin() + kJump + kSkipped);
  drive.samples[kJump].starts_segment = true;
  const RunOutcome out = run(drive);
  const double turned_rad = between(out.steps[kJump].T_local_body, out.steps[kLater].T_local_body).yaw_rad();
  EXPECT_NEAR(turned_rad, between(drive.T_room_body[kJump], drive.T_room_body[kLater]).yaw_rad(), radians(1));
}

TEST(Frontend, TakesNoWallsAlongToAnotherStoreyButTheMotion) {
  RoomDrive drive = usual_drive(11, {0.2, 0.0});
  constexpr std::size_t kStairs = 120;
  for (std::size_t i = kStairs; i < drive.samples.size(); ++i) drive.samples[i].storey = StoreyId{1};
  const RunOutcome out = run(drive);
  ASSERT_TRUE(out.steps[kStairs].has_keyframe);
  EXPECT_LT(out.steps[kStairs].made.motion_covariance.xx, 0.01);
  expect_other_walls_from(kStairs, out);
}

TEST(Frontend, StaysFiniteWhileTheStoreyChangesOnTheSpot) {
  RoomDrive drive = usual_drive(11);
  constexpr std::size_t kStairs = 120;
  constexpr std::size_t kStays = 5;
  const RangeSample there = drive.samples[kStairs];
  const Pose2 T_room_body = drive.T_room_body[kStairs];
  drive.samples.insert(drive.samples.begin() + kStairs, kStays, there);
  drive.T_room_body.insert(drive.T_room_body.begin() + kStairs, kStays, T_room_body);
  for (std::size_t i = 1; i <= kStays; ++i)
    drive.samples[kStairs + i].storey = StoreyId{static_cast<std::uint8_t>(i % 2)};
  const RunOutcome out = run(drive);
  for (const FrontendStep& step : out.steps) ASSERT_TRUE(step.T_local_body.vector().allFinite());
  for (std::size_t at = kStairs + 1; at <= kStairs + kStays + 1; ++at) {
    const Keyframe& made = out.steps[at].made;
    ASSERT_TRUE(out.steps[at].has_keyframe);
    EXPECT_GT(made.motion_covariance.xx, 0.0);
    EXPECT_GT(made.motion_covariance.yaw_yaw, 0.0);
    const Pose2 step = between(made.T_local_keyframe.end()[-2], made.T_local_keyframe.back());
    EXPECT_LT(std::hypot(step.x_m(), step.y_m()), at > kStairs + 1 && at <= kStairs + kStays ? 0.001 : 0.6);
  }
  EXPECT_LT(relative_error(drive, out.steps, 200).position_m,
            1.2 * relative_error(usual_drive(11), run(usual_drive(11)).steps, 200).position_m);
}

/// Chi-square per degree of freedom over a drive.
double innovation_of(const RoomDrive& drive, const FrontendConfig& config = {}) {
  double chi_square = 0.0;
  double degrees = 0.0;
  for (const FrontendStep& step : run(drive, config).steps) {
    if (!step.has_keyframe) continue;
    EXPECT_GE(step.made.innovation, 0.0);
    EXPECT_TRUE(step.made.innovation_dof > 0 || step.made.innovation == 0.0);
    chi_square += step.made.innovation;
    degrees += step.made.innovation_dof;
  }
  return degrees > 0.0 ? chi_square / degrees : 0.0;
}

TEST(Frontend, TellsHowWellKnownWallsFit) {
  const double usual = innovation_of(usual_drive(12));
  EXPECT_GT(usual, 0.0);
  EXPECT_LT(usual, 2.0);
  FrontendConfig odometry;
  odometry.use_landmarks = false;
  EXPECT_EQ(innovation_of(usual_drive(12), odometry), 0.0);
  FrontendConfig trusting;
  trusting.association_mahalanobis2 = 1e6;
  RoomDrive leaning = usual_drive(12);
  for (std::size_t i = 150; i < 190; ++i)
    leaning.samples[i].distance_m[1] += 0.006F * static_cast<float>(i - 150);
  EXPECT_GT(innovation_of(leaning, trusting), 1.2 * innovation_of(usual_drive(12), trusting));
}

TEST(Frontend, RollsBackABatchThatContradictsTheRest) {
  RoomDrive drive = usual_drive(12, {0.2, 0.0});
  // For a metre and a half the left beam reads steadily longer: the wall seems to lean away.
  for (std::size_t i = 150; i < 190; ++i)
    drive.samples[i].distance_m[1] += 0.006F * static_cast<float>(i - 150);
  FrontendConfig trusting;
  trusting.association_mahalanobis2 = 1e6;
  EXPECT_GT(run(drive, trusting).counters.batches_rolled_back, 0U);
}

TEST(Frontend, GivesTheSameForTheSame) {
  const RoomDrive drive = usual_drive(13);
  const RunOutcome first = run(drive);
  const RunOutcome second = run(drive);
  for (std::size_t i = 0; i < first.steps.size(); ++i) {
    ASSERT_EQ(first.steps[i].T_local_body.vector(), second.steps[i].T_local_body.vector());
    ASSERT_EQ(first.steps[i].made.landmarks.size(), second.steps[i].made.landmarks.size());
  }
}

TEST(Frontend, WorksWithNoReturnsAtAll) {
  RoomDrive drive = usual_drive(14);
  for (RangeSample& sample : drive.samples) sample.status.fill(RangeStatus::kNoReturn);
  const RunOutcome out = run(drive);
  EXPECT_EQ(out.counters.lines_extracted, 0U);
  EXPECT_EQ(out.counters.samples, drive.samples.size());
}

TEST(Frontend, WorksWithManyBeams) {
  BeamLayout beams;
  beams.count = kMaxBeams;
  for (std::size_t i = 0; i < kMaxBeams; ++i)
    beams.bearing_rad[i] = kPi * (static_cast<double>(i) / (kMaxBeams - 1) - 0.5);
  const RoomDrive drive = drive_around(1, beams, SensorModel::crazyflie(), {1.0, 0.0}, 15);
  FrontendConfig dead_reckoning;
  dead_reckoning.use_landmarks = false;
  EXPECT_LT(relative_error(drive, run(drive, {}, beams).steps, 200).yaw_rad,
            relative_error(drive, run(drive, dead_reckoning, beams).steps, 200).yaw_rad);
}

}  // namespace
}  // namespace swiftlet
