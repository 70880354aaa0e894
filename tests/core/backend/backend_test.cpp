// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "core/backend/backend.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "tests/support/closure_error.hpp"
#include "tests/support/dead_reckoning_frontend.hpp"
#include "tests/support/loop_corridor.hpp"
#include "tests/support/pose_near.hpp"
#include "tests/support/trajectory_error.hpp"

namespace swiftlet {
namespace {

constexpr double kChiSquare99 = 11.34;  // of three degrees of freedom

/// Errs in what loops can tell; none of them shows a wrong scale.
TestVehicleModel drifting() {
  TestVehicleModel model;
  model.drift_rad_per_m = 0.008;
  model.odometry_sigma_m = 0.003;
  return model;
}

std::unique_ptr<Backend> make_backend(const BackendConfig& config = {}) {
  return std::make_unique<Backend>(config, SensorModel::crazyflie(), BeamLayout::multiranger());
}

void feed(Backend& backend, const std::vector<RangeSample>& samples, const DeadReckoningNoise& noise = {}) {
  DeadReckoningFrontend frontend(noise);
  for (const RangeSample& sample : samples) backend.add(frontend.process(sample));
}

/// Two laps of the corridor with drift, flown once for all tests.
const TestVehicle& two_laps() {
  static const TestVehicle kVehicle = [] {
    TestVehicle vehicle = vehicle_at_start(drifting(), 3);
    fly_along(vehicle, loop_corridor(), "bcdabcda");
    return vehicle;
  }();
  return kVehicle;
}

/// What a backend makes of the two laps, finish() included; run once for all tests that only look.
const Backend& finished_two_laps() {
  static const std::unique_ptr<Backend> kBackend = [] {
    auto backend = make_backend();
    feed(*backend, two_laps().samples());
    backend->finish();
    return backend;
  }();
  return *kBackend;
}

std::vector<Pose2> corrected(const Backend& backend) {
  std::vector<Pose2> T_map_body;
  for (const auto& [id, scan] : backend.scans().all()) T_map_body.push_back(backend.T_map_body(id));
  return T_map_body;
}
std::vector<Pose2> dead_reckoned(const TestVehicle& vehicle) {
  std::vector<Pose2> T_odom_body;
  for (const RangeSample& sample : vehicle.samples()) T_odom_body.push_back(sample.T_odom_body);
  return T_odom_body;
}

Pose2 T_from_to_truth(const TestVehicle& vehicle, const Backend& backend, const LoopClosure& closure) {
  const auto truth_at = [&](KeyframeId keyframe) {
    return vehicle.T_world_body()[index_of(backend.keyframes().scan_of(keyframe))];
  };
  return between(truth_at(closure.from), truth_at(closure.to));
}

TEST(Backend, LoopsBringTheFlightNearTheTruth) {
  const std::vector<Pose2>& truth = two_laps().T_world_body();
  const double odometry_m = aligned_rms_error_m(dead_reckoned(two_laps()), truth);
  ASSERT_GT(odometry_m, 0.5) << "there is something to correct";
  EXPECT_LT(aligned_rms_error_m(corrected(finished_two_laps()), truth), 0.2 * odometry_m);
  EXPECT_FALSE(finished_two_laps().closures().empty());
}

TEST(Backend, ClosuresLieWithinTheUncertaintyTheyClaim) {
  const Backend& backend = finished_two_laps();
  std::size_t within = 0;
  for (const LoopClosure& c : backend.closures().values())
    within += chi_square_against(c, T_from_to_truth(two_laps(), backend, c)) < kChiSquare99 ? 1U : 0U;
  EXPECT_GE(static_cast<double>(within), 0.95 * static_cast<double>(backend.closures().size()));
}

TEST(Backend, CountersTellWhatItHolds) {
  const Backend& backend = finished_two_laps();
  const BackendCounters& counters = backend.counters();
  EXPECT_EQ(counters.scans, two_laps().samples().size());
  EXPECT_EQ(counters.scans, backend.scans().size());
  EXPECT_EQ(counters.keyframes, backend.keyframes().size());
  EXPECT_EQ(counters.closures_accepted, backend.closures().size());
  EXPECT_GE(counters.candidates_matched, counters.closures_accepted);
  EXPECT_GT(counters.submaps, 20U) << "76 m in submaps of 6 m that overlap by half";
  EXPECT_GT(counters.optimizations, 0U);
  EXPECT_EQ(counters.solver_failures, 0U);
  std::uint64_t dropped = 0;
  for (const LoopClosure& c : backend.closures().values()) dropped += c.dropped ? 1U : 0U;
  EXPECT_EQ(counters.closures_dropped, dropped);
}

TEST(Backend, TwoRunsGiveTheSameBytes) {
  const Backend& one = finished_two_laps();
  const auto other = make_backend();
  feed(*other, two_laps().samples());
  other->finish();
  for (const auto& [i, scan] : one.scans().all()) {
    const Eigen::Vector3d a = one.T_map_body(i).vector();
    const Eigen::Vector3d b = other->T_map_body(i).vector();
    for (int k = 0; k < 3; ++k)
      ASSERT_EQ(std::bit_cast<std::uint64_t>(a[k]), std::bit_cast<std::uint64_t>(b[k]))
          << "scan " << index_of(i);
  }
  ASSERT_EQ(one.closures().size(), other->closures().size());
  for (const auto& [id, closure] : one.closures()) {
    EXPECT_EQ(closure.id, id);
    EXPECT_EQ(closure.from, other->closures()[id].from);
    EXPECT_EQ(closure.to, other->closures()[id].to);
    EXPECT_EQ(closure.dcs_scale, other->closures()[id].dcs_scale);
  }
}

TEST(Backend, WithoutLoopClosingTheFrontendsPathStays) {
  BackendConfig config;
  config.close_loops = false;
  const auto backend = make_backend(config);
  feed(*backend, two_laps().samples());
  const BackendUpdate last = backend->finish();
  EXPECT_FALSE(last.poses_changed);
  EXPECT_TRUE(backend->closures().empty());
  EXPECT_EQ(backend->counters().candidates_matched, 0U);
  for (const auto& [id, scan] : backend->scans().all())
    ASSERT_TRUE(
        poses_near(backend->T_map_body(id), two_laps().samples()[index_of(id)].T_odom_body, 1e-9, 1e-9))
        << index_of(id);
}

TEST(Backend, EachStepSaysWhatItDid) {
  BackendConfig config;
  config.refine = false;
  const auto backend = make_backend(config);
  DeadReckoningFrontend frontend;
  std::uint32_t version = 0;
  std::size_t closures = 0;
  for (const RangeSample& sample : two_laps().samples()) {
    const FrontendStep step = frontend.process(sample);
    const BackendUpdate update = backend->add(step);
    closures += update.new_closures;
    ASSERT_EQ(backend->closures().size(), closures);
    const MapCorrection correction = backend->correction();
    ASSERT_GE(correction.version, version);
    ASSERT_TRUE(!update.poses_changed || correction.version > version) << "a change is announced";
    ASSERT_TRUE(step.has_keyframe || update.new_closures == 0) << "only keyframes close loops";
    version = correction.version;
    ASSERT_EQ(index_of(correction.keyframe) + 1, backend->keyframes().size());
    ASSERT_TRUE(!step.has_keyframe || poses_near(correction.T_map_local * step.T_local_body,
                                                 backend->T_map_keyframe(correction.keyframe), 1e-9, 1e-9))
        << "the correction leads to the newest keyframe";
  }
  EXPECT_GT(closures, 0U);
}

TEST(Backend, NoOldPoseMovesUnannounced) {
  const auto backend = make_backend();
  DeadReckoningFrontend frontend;
  std::vector<Pose2> before;
  std::uint32_t version = 0;
  std::size_t windows = 0;
  for (const RangeSample& sample : two_laps().samples()) {
    const FrontendStep step = frontend.process(sample);
    const BackendUpdate update = backend->add(step);
    const MapCorrection correction = backend->correction();
    ASSERT_TRUE(step.has_keyframe || update.refined.empty()) << "only keyframes refine";
    ASSERT_TRUE(update.refined.empty() || correction.version > version) << "a change is announced";
    version = correction.version;
    if (!step.has_keyframe) continue;
    windows += update.refined.empty() ? 0U : 1U;
    // The newest scans hung on the keyframe before and have now found their place.
    const std::vector<Pose2> now = corrected(*backend);
    for (std::size_t i = 0; i + 60 < before.size() && !update.poses_changed; ++i) {
      const bool announced = update.refined.contains(make_id<ScanId>(i));
      ASSERT_TRUE(announced || poses_near(now[i], before[i], 0.0, 0.0)) << "scan " << i;
    }
    before = now;
    EXPECT_TRUE(poses_near(correction.T_map_local * step.T_local_body,
                           backend->T_map_keyframe(correction.keyframe), 0.2, 0.05))
        << "the correction leads to the newest keyframe, or nearly so";
  }
  EXPECT_GT(windows, 40U);
  EXPECT_EQ(backend->counters().windows_refined, windows);
  EXPECT_EQ(backend->counters().windows_refined + backend->counters().windows_refused,
            backend->keyframes().size());
  EXPECT_GT(backend->counters().stretches_refined, 0U);
}

/// How far scans of the second half lie from where the nearest one of the first half should see them.
double error_between_laps_m(const std::vector<Pose2>& estimate, const std::vector<Pose2>& truth) {
  double sum_m = 0.0;
  std::size_t count = 0;
  for (std::size_t i = truth.size() / 2; i < truth.size(); i += 5) {
    const auto distance_m = [&](const Pose2& pose) {
      return std::hypot(pose.x_m() - truth[i].x_m(), pose.y_m() - truth[i].y_m());
    };
    const auto nearest =
        std::min_element(truth.begin(), truth.begin() + static_cast<std::ptrdiff_t>(truth.size() / 2),
                         [&](const Pose2& a, const Pose2& b) { return distance_m(a) < distance_m(b); });
    const Pose2& T_map_there = estimate[static_cast<std::size_t>(nearest - truth.begin())];
    const Pose2 off = between(between(*nearest, truth[i]), between(T_map_there, estimate[i]));
    sum_m += std::hypot(off.x_m(), off.y_m());
    ++count;
  }
  return sum_m / static_cast<double>(count);
}

TEST(Backend, RefinementBringsTheLapsTogetherWhileFlying) {
  const auto error_m = [](bool refine) {
    BackendConfig config;
    config.refine = refine;
    const auto backend = make_backend(config);
    feed(*backend, two_laps().samples());
    return error_between_laps_m(corrected(*backend), two_laps().T_world_body());
  };
  EXPECT_LT(error_m(true), 0.7 * error_m(false));
}

TEST(Backend, KeyframesLieWhereTheirScansDo) {
  const auto backend = make_backend();
  feed(*backend, two_laps().samples());
  const auto expect_agreement = [&] {
    for (const auto& [keyframe, scan] : backend->keyframes().all()) {
      EXPECT_EQ(backend->scans()[scan].keyframe, keyframe);
      EXPECT_TRUE(poses_near(backend->T_map_body(scan), backend->T_map_keyframe(keyframe), 1e-9, 1e-9));
    }
  };
  expect_agreement();
  backend->finish();
  expect_agreement();
}

TEST(Backend, TheFirstKeyframeStays) {
  EXPECT_TRUE(poses_near(finished_two_laps().T_map_keyframe(KeyframeId{0}), Pose2(), 0.0, 0.0));
}

TEST(Backend, TheFinalPassDropsTheClosuresThatContradictTheRest) {
  // On the third lap the whole building stands elsewhere, as a place that looks like another would; the dead
  // reckoning, exact and known to be, disagrees.
  TestVehicle vehicle = vehicle_at_start({}, 5);
  fly_along(vehicle, loop_corridor(), "bcdabcda");
  fly_along(vehicle, loop_corridor({0.35, 0.35}), "bcda");
  BackendConfig config;
  config.max_kernel_cells = 1;  // sharp matches, so that the contradiction is plain
  config.drop_scale = 0.5;
  config.refine = false;  // the moved building is not to be mended
  const auto backend = make_backend(config);
  feed(*backend, vehicle.samples(),
       {.floor_m = 1e-4, .per_metre_m = 1e-4, .floor_rad = 1e-5, .per_metre_rad = 1e-5});
  backend->finish();
  std::size_t good = 0;
  std::size_t planted = 0;
  for (const LoopClosure& c : backend->closures().values()) {
    const double chi_square = chi_square_against(c, T_from_to_truth(vehicle, *backend, c));
    good += chi_square < kChiSquare99 ? 1U : 0U;
    planted += chi_square > 3.0 * kChiSquare99 ? 1U : 0U;
    EXPECT_FALSE(c.dropped && chi_square < kChiSquare99) << index_of(c.from) << " to " << index_of(c.to);
    EXPECT_FALSE(!c.dropped && chi_square > 3.0 * kChiSquare99)
        << index_of(c.from) << " to " << index_of(c.to);
  }
  EXPECT_GT(good, 10U);
  EXPECT_GT(planted, 10U);
  EXPECT_LT(aligned_rms_error_m(corrected(*backend), vehicle.T_world_body()), 0.05);
}

TEST(Backend, ALapOnAnotherStoreyClosesNoLoopWithTheOneBelow) {
  TestVehicle vehicle = vehicle_at_start({}, 3);
  fly_along(vehicle, loop_corridor(), "bcdabcdabcd");
  std::vector<RangeSample> samples = vehicle.samples();
  const auto is_above = [&](std::size_t i) { return i > samples.size() / 3 && i < 2 * samples.size() / 3; };
  for (std::size_t i = 0; i < samples.size(); ++i)
    if (is_above(i)) samples[i].storey = StoreyId{1};
  const auto backend = make_backend();
  feed(*backend, samples);
  backend->finish();
  ASSERT_FALSE(backend->closures().empty()) << "the last lap is on the first one's storey";
  for (const LoopClosure& closure : backend->closures().values())
    EXPECT_EQ(backend->keyframes().storey(closure.from), backend->keyframes().storey(closure.to));
  EXPECT_LT(aligned_rms_error_m(corrected(*backend), vehicle.T_world_body()), 0.1);
}

TEST(Backend, AFlightThatGoesOnElsewhereIsJoinedByItsLoops) {
  TestVehicle vehicle = vehicle_at_start({}, 6);
  fly_along(vehicle, loop_corridor(), "bcda");
  // Set down near the start, yet not quite: the dead reckoning begins anew as if it were the start.
  const Point2 start = loop_corridor().place('a');
  vehicle.carry_to(loop_corridor(), Pose2(start.x_m + 0.7, start.y_m + 0.5, 0.2));
  fly_along(vehicle, loop_corridor(), "bcd");
  const auto backend = make_backend();
  feed(*backend, vehicle.samples());
  backend->finish();
  EXPECT_GT(aligned_rms_error_m(dead_reckoned(vehicle), vehicle.T_world_body()), 0.3);
  EXPECT_LT(aligned_rms_error_m(corrected(*backend), vehicle.T_world_body()), 0.15);
}

TEST(Backend, ALongWayIsGoneOverTheNextKeyframes) {
  BackendConfig config;
  config.refine = false;
  config.match_every_keyframes = 100;  // a single query that finds anything, in the second lap
  const auto backend = make_backend(config);
  DeadReckoningFrontend frontend;
  std::vector<std::size_t> changed_at;
  for (const RangeSample& sample : two_laps().samples()) {
    const BackendUpdate update = backend->add(frontend.process(sample));
    if (update.poses_changed) changed_at.push_back(backend->keyframes().size());
    if (backend->keyframes().size() == 105) break;
  }
  ASSERT_FALSE(backend->closures().empty());
  ASSERT_GT(changed_at.size(), 1U) << "one call alone does not get there";
  EXPECT_EQ(changed_at[1], changed_at[0] + 1) << "the next keyframe goes on";
  const std::vector<Pose2> live = corrected(*backend);
  const std::uint64_t steps = backend->counters().optimizations;
  backend->finish();
  EXPECT_LT(steps, 5U) << "and rests once it is there";
  for (std::size_t i = 0; i < live.size(); ++i)
    ASSERT_TRUE(poses_near(live[i], backend->T_map_body(make_id<ScanId>(i)), 0.01, 0.01)) << "scan " << i;
}

TEST(Backend, WallsAreKeptOnceEachWithTheirLastAnchor) {
  const auto backend = make_backend();
  DeadReckoningFrontend frontend;
  std::uint32_t keyframe = 0;
  for (const RangeSample& sample : two_laps().samples()) {
    FrontendStep step = frontend.process(sample);
    if (step.has_keyframe) {
      const double end_m = keyframe;
      // Walls 9, 8, 7, ... and wall 20 always.
      const LandmarkId own{9 - keyframe};
      ASSERT_TRUE(step.made.landmarks.try_push_back({LandmarkId{20}, {0.0, 1.0}, {end_m, 1.0}}));
      ASSERT_TRUE(step.made.landmarks.try_push_back({own, {0.0, 2.0}, {end_m, 2.0}}));
      ++keyframe;
    }
    backend->add(step);
    if (keyframe == 5) break;
  }
  ASSERT_EQ(backend->walls().size(), 6U);
  for (std::uint32_t i = 0; i < 5; ++i) {
    EXPECT_EQ(backend->walls()[i].id, LandmarkId{5 + i}) << "in the order of their ids";
    EXPECT_EQ(backend->walls()[i].anchor, KeyframeId{4 - i});
  }
  EXPECT_EQ(backend->walls()[5].id, LandmarkId{20});
  EXPECT_EQ(backend->walls()[5].anchor, KeyframeId{4});
  EXPECT_EQ(backend->walls()[5].end_keyframe.x_m, 4.0);
}

/// Error of the heading at the end of two laps against the one at scan `from`, with a frontend that sees two
/// walls at every keyframe, along and across the building. `samples`: of two_laps(), dead reckoning changed.
double yaw_error_at_the_end_rad(const std::vector<RangeSample>& samples, std::size_t from,
                                bool align_to_walls) {
  BackendConfig config;
  config.close_loops = false;
  config.align_to_walls = align_to_walls;
  const auto backend = make_backend(config);
  const std::vector<Pose2>& T_world_body = two_laps().T_world_body();
  DeadReckoningFrontend frontend;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    FrontendStep step = frontend.process(samples[i]);
    const Pose2 T_body_world = T_world_body[i].inverse();
    const Point2 here = T_world_body[i].position();
    for (const Point2& end : {Point2{here.x_m + 4.0, here.y_m}, Point2{here.x_m, here.y_m + 3.0}}) {
      const auto id = make_id<LandmarkId>(2 * index_of(step.made.id) + (end.y_m > here.y_m ? 1 : 0));
      if (step.has_keyframe)
        (void)step.made.landmarks.try_push_back({id, T_body_world * here, T_body_world * end});
    }
    backend->add(step);
  }
  backend->finish();
  const std::size_t last = samples.size() - 1;
  return std::abs(wrap_angle(
      between(backend->T_map_body(make_id<ScanId>(from)), backend->T_map_body(make_id<ScanId>(last)))
          .yaw_rad() -
      between(T_world_body[from], T_world_body[last]).yaw_rad()));
}

TEST(Backend, WallsHoldTheHeadingWhereNoLoopCloses) {
  const double without_rad = yaw_error_at_the_end_rad(two_laps().samples(), 0, false);
  EXPECT_GT(without_rad, radians(30)) << "0.008 rad/m over 76 m";
  EXPECT_LT(3.0 * yaw_error_at_the_end_rad(two_laps().samples(), 0, true), without_rad)
      << "what is left bends both ends";
}

TEST(Backend, WallsFromBeforeAnUnknownMotionTellNoHeading) {
  std::vector<RangeSample> samples = two_laps().samples();
  const double heading_sought_m = 0.5 * BackendConfig().submap_length_m;
  std::size_t restart = 0;  // where it is sought: nearly all walls were seen before
  for (double path_m = 0.0; path_m < heading_sought_m; ++restart) {
    const Pose2 moved = between(samples[restart].T_odom_body, samples[restart + 1].T_odom_body);
    path_m += std::hypot(moved.x_m(), moved.y_m());
  }
  for (std::size_t i = 0; i < restart; ++i)
    samples[i].T_odom_body = Pose2(0.0, 0.0, radians(25)) * samples[i].T_odom_body;
  samples[restart].starts_segment = true;
  EXPECT_LT(3.0 * yaw_error_at_the_end_rad(samples, restart, true),
            yaw_error_at_the_end_rad(samples, restart, false));
}

TEST(Backend, AnEmptyRunFinishesQuietly) {
  const auto backend = make_backend();
  EXPECT_FALSE(backend->finish().poses_changed);
  EXPECT_EQ(backend->keyframes().size(), 0U);
  EXPECT_EQ(backend->correction().version, 0U);
}

TEST(BackendDeathTest, AnUnusableConfigurationIsABrokenPromise) {
  BackendConfig config;
  config.max_kernel_cells = 2;
  EXPECT_DEATH(make_backend(config), "broken promise.*configuration");
}

}  // namespace
}  // namespace swiftlet
