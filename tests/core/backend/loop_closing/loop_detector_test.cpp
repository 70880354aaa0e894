// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "core/backend/loop_closing/loop_detector.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <vector>

#include "core/geometry/pose_residual.hpp"
#include "tests/support/closure_error.hpp"
#include "tests/support/loop_corridor.hpp"
#include "tests/support/other_storey.hpp"
#include "tests/support/stored_run.hpp"

namespace swiftlet {
namespace {

using testing::IsEmpty;

constexpr std::uint32_t kSubmapKeyframes = 12;
constexpr double kChiSquare99 = 11.34;  // of three degrees of freedom

/// A lap with exact dead reckoning and the beginning of a second: as the backend holds it when it looks for
/// loops.
class LoopDetectorTest : public testing::Test {
 protected:
  static TestVehicle lap_and_a_side() {
    TestVehicle vehicle = vehicle_at_start({}, 7);
    fly_along(vehicle, loop_corridor(), "bcdab");
    return vehicle;
  }

  explicit LoopDetectorTest(const TestVehicle& vehicle = lap_and_a_side()) : run_(vehicle.samples()) {
    for (std::uint32_t first = 0; first + kSubmapKeyframes <= index_of(run_.newest());
         first += kSubmapKeyframes / 2) {
      submaps_.push_back(std::make_shared<const Submap>(
          build_submap(static_cast<KeyframeId>(first), static_cast<KeyframeId>(first + kSubmapKeyframes),
                       run_.scans(), run_.chain(), run_.T_local_keyframe(), config_)));
    }
    graph_.T_map_keyframe = run_.T_local_keyframe();
    const Eigen::Matrix3d step_covariance = Eigen::Vector3d(4e-4, 4e-4, 1e-4).asDiagonal();
    for (std::uint32_t to = 1; to <= index_of(run_.newest()); ++to) {
      const Pose2 T_from_to =
          between(graph_.T_map_keyframe.values()[to - 1], graph_.T_map_keyframe.values()[to]);
      graph_.factors.push_back({static_cast<KeyframeId>(to - 1), static_cast<KeyframeId>(to), T_from_to,
                                residual_information(T_from_to, step_covariance)});
    }
  }

  FoundLoops find_all(KeyframeId query, KeyframeId since = {}) {
    tried_ = 0;
    return LoopDetector(config_, run_.scans(), run_.chain())
        .find(query, since, submaps_, graph_, run_.T_local_keyframe(), tried_);
  }
  std::vector<LoopClosure> find(KeyframeId query) { return find_all(query).confirmed; }
  [[nodiscard]] Pose2 T_from_to_truth(const LoopClosure& c) const {
    return between(run_.T_local_keyframe()[c.from], run_.T_local_keyframe()[c.to]);
  }

  BackendConfig config_;
  StoredRun run_;
  std::vector<std::shared_ptr<const Submap>> submaps_;
  PoseGraph graph_;
  std::uint64_t tried_ = 0;
};

TEST_F(LoopDetectorTest, FindsThePlacesOfTheFirstLapInTheSecond) {
  const std::vector<LoopClosure> closures = find(run_.newest());
  ASSERT_FALSE(closures.empty());
  EXPECT_GE(tried_, closures.size());
  for (const LoopClosure& c : closures) {
    EXPECT_EQ(c.to, run_.newest());
    EXPECT_GE(c.score, config_.min_score);
    EXPECT_FALSE(c.dropped);
    EXPECT_LT(chi_square_against(c, T_from_to_truth(c)), kChiSquare99);
  }
}

TEST_F(LoopDetectorTest, AcrossABreakOfMotionNoMatchIsSureAlone) {
  const FoundLoops watched = find_all(run_.newest());
  const FoundLoops across = find_all(run_.newest(), run_.newest());
  EXPECT_TRUE(across.confirmed.empty());
  EXPECT_GE(across.tentative.size(), watched.confirmed.size());
}

TEST_F(LoopDetectorTest, FindsThemFromAPredictionThatHasDrifted) {
  // From the second lap on the map is off, as before a loop is closed.
  const Pose2 T_drift(0.4, -0.3, 0.04);
  for (std::size_t k = index_of(run_.newest()) - 25; k < graph_.T_map_keyframe.size(); ++k)
    graph_.T_map_keyframe.values()[k] = T_drift * graph_.T_map_keyframe.values()[k];
  const std::vector<LoopClosure> closures = find(run_.newest());
  ASSERT_FALSE(closures.empty());
  for (const LoopClosure& c : closures) EXPECT_LT(chi_square_against(c, T_from_to_truth(c)), kChiSquare99);
}

TEST_F(LoopDetectorTest, SearchesNothingWhereNothingWasFlownBefore) {
  // Halfway around the first lap.
  EXPECT_TRUE(find(static_cast<KeyframeId>(45)).empty());
  EXPECT_EQ(tried_, 0U);
}

TEST_F(LoopDetectorTest, LeavesRecentSubmapsAlone) {
  for (std::uint32_t query = 0; query <= index_of(run_.newest()); query += 5) {
    for (const LoopClosure& c : find(static_cast<KeyframeId>(query)))
      EXPECT_GT(run_.chain().path_m(c.to) - run_.chain().path_m(c.from), config_.min_travel_between_m);
  }
  config_.min_travel_between_m = 1000.0;
  EXPECT_TRUE(find(run_.newest()).empty());
  EXPECT_EQ(tried_, 0U);
}

TEST_F(LoopDetectorTest, AnotherStoreyIsNotSearched) {
  ASSERT_FALSE(find(run_.newest()).empty());
  submaps_ = one_storey_up(submaps_);
  EXPECT_TRUE(find(run_.newest()).empty());
  EXPECT_EQ(tried_, 0U);
}

TEST_F(LoopDetectorTest, FewerPointsThanConfiguredDecideNothing) {
  config_.min_match_points = 100000;
  EXPECT_TRUE(find(run_.newest()).empty());
  EXPECT_EQ(tried_, 0U);
}

TEST_F(LoopDetectorTest, SearchesNoMoreSubmapsThanConfigured) {
  find(run_.newest());
  ASSERT_GT(tried_, 1U);
  config_.max_candidates = 1;
  EXPECT_LE(find(run_.newest()).size(), 1U);
  EXPECT_EQ(tried_, 1U);
}

TEST_F(LoopDetectorTest, AStretchWithoutAKeyframeBehindItIsNotMatched) {
  config_.multiscan_length_m = 0.2;  // less than from keyframe to keyframe
  config_.min_match_points = 3;
  EXPECT_THAT(find(run_.newest()), IsEmpty());
  EXPECT_EQ(tried_, 0U);
}

/// The first keyframe, at the end of the first lap, from which old ground is found.
class LoopDetectorAtFirstContactTest : public LoopDetectorTest {
 protected:
  [[nodiscard]] KeyframeId first_contact() {
    for (KeyframeId query{}; query <= run_.newest(); query = query + 1)
      if (!find(query).empty()) return query;
    ADD_FAILURE() << "no closure";
    return {};
  }
  KeyframeId first_contact_by(double newer_query_m) {
    config_.tuning.detector.newer_query_m = newer_query_m;
    return first_contact();
  }
};

TEST_F(LoopDetectorAtFirstContactTest, InANarrowWindowTheNewerTravelIsEnough) {
  const KeyframeId by_the_whole = first_contact_by(config_.multiscan_length_m);
  const KeyframeId by_the_newer = first_contact_by(4.0);
  EXPECT_LT(by_the_newer, by_the_whole);
  for (const LoopClosure& c : find(by_the_newer))
    EXPECT_LT(chi_square_against(c, T_from_to_truth(c)), kChiSquare99);
}

TEST_F(LoopDetectorAtFirstContactTest, InAWindowThatReachesFartherItIsNot) {
  for (RelativePoseFactor<KeyframeId>& step : graph_.factors.values()) step.information /= 100.0;
  EXPECT_EQ(first_contact_by(4.0), first_contact_by(config_.multiscan_length_m));
}

TEST_F(LoopDetectorTest, KeepsNoMatchBelowTheLeastScore) {
  config_.min_score = 0.95;  // of the points; of the overlap as well, which is full here
  for (const LoopClosure& c : find(run_.newest())) EXPECT_GE(c.score, 0.95);
  config_.min_score = 0.999;
  const FoundLoops found = find_all(run_.newest());
  EXPECT_THAT(found.confirmed, IsEmpty());
  EXPECT_THAT(found.tentative, IsEmpty());
}

TEST_F(LoopDetectorTest, AWiderWindowAsksForAHigherScore) {
  const auto best_score = [this] {
    return std::ranges::max(find(run_.newest()), {}, &LoopClosure::score).score;
  };
  const auto information_times = [this](double factor) {
    for (RelativePoseFactor<KeyframeId>& step : graph_.factors.values()) step.information *= factor;
  };
  information_times(1e4);
  config_.min_score = best_score() - 0.01;
  EXPECT_FALSE(find(run_.newest()).empty()) << "in the narrowest window it is the least";
  config_.min_score = 0.3;
  information_times(1e-8);
  config_.min_score = best_score() - 0.01;
  const FoundLoops wide = find_all(run_.newest());
  EXPECT_THAT(wide.confirmed, IsEmpty());
  EXPECT_FALSE(wide.tentative.empty()) << "proves nothing alone";
}

/// After a lap someone carries the vehicle on; it has hardly flown since.
class LoopDetectorAfterCarryingTest : public LoopDetectorTest {
 protected:
  static TestVehicle carried() {
    TestVehicle vehicle = lap_and_a_side();
    const Point2 near_b = loop_corridor().place('b');
    vehicle.carry_to(loop_corridor(), Pose2(near_b.x_m, near_b.y_m, kPi / 2.0));
    vehicle.fly_to(loop_corridor(), {near_b.x_m, near_b.y_m + 0.55});
    return vehicle;
  }
  LoopDetectorAfterCarryingTest() : LoopDetectorTest(carried()) {}
};

TEST_F(LoopDetectorAfterCarryingTest, WhatWasSeenBeforeIsNotMatchedAsIfItWereConnected) {
  // The few decimetres since give too few points; all of the multiscan's length would give plenty.
  config_.min_match_points = 60;
  find(run_.newest());
  EXPECT_EQ(tried_, 0U);
}

TEST_F(LoopDetectorTest, SearchesAsFarAsTheHeadingAtTheSubmapLeavesOpen) {
  constexpr double kSigmaRad = 0.2;
  std::shared_ptr<const Submap> far;
  for (const LoopClosure& c : find(run_.newest())) {
    for (const auto& submap : submaps_) {
      if (submap->reference == c.from && T_from_to_truth(c).x_m() > 4.0) far = submap;
    }
  }
  ASSERT_NE(far, nullptr);
  submaps_ = {far};
  const Eigen::Matrix3d tight = 1e-8 * Eigen::Matrix3d::Identity();
  const Eigen::Matrix3d open = Eigen::Vector3d(1e-8, 1e-8, kSigmaRad * kSigmaRad).asDiagonal();
  const std::uint32_t reference = index_of(far->reference);
  for (RelativePoseFactor<KeyframeId>& c : graph_.factors.values())
    c.information = residual_information(c.T_from_to, index_of(c.from) == reference ? open : tight);
  const Pose2 T_map_reference = graph_.T_map_keyframe.values()[reference];
  const Pose2 T_turned = T_map_reference * Pose2(0.0, 0.0, kSigmaRad) * T_map_reference.inverse();
  for (std::size_t k = reference + 1; k < graph_.T_map_keyframe.size(); ++k)
    graph_.T_map_keyframe.values()[k] = T_turned * graph_.T_map_keyframe.values()[k];
  const std::vector<LoopClosure> closures = find(run_.newest());
  ASSERT_EQ(closures.size(), 1U);
  EXPECT_LT(chi_square_against(closures[0], T_from_to_truth(closures[0])), kChiSquare99);
}

}  // namespace
}  // namespace swiftlet
