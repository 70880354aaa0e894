// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "core/backend/loop_closing/place_search.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <vector>

#include "core/geometry/angle.hpp"
#include "tests/support/loop_corridor.hpp"
#include "tests/support/other_storey.hpp"
#include "tests/support/pose_near.hpp"
#include "tests/support/stored_run.hpp"

namespace swiftlet {
namespace {

/// A lap, and half of a second one after a break that turned and moved the dead reckoning.
class PlaceSearchTest : public testing::Test {
 protected:
  PlaceSearchTest() : vehicle_(lap_and_a_half()), run_(vehicle_.samples(), torn(vehicle_)) {}

  static TestVehicle lap_and_a_half() {
    TestVehicle vehicle = vehicle_at_start({}, 7);
    fly_along(vehicle, loop_corridor(), "bcdabc");
    return vehicle;
  }
  /// The true path, and from the second lap on another place and heading.
  static std::vector<Pose2> torn(const TestVehicle& vehicle) {
    const Pose2 T_map_torn(31.0, -17.0, radians(140.0));
    double way_m = 0.0;
    std::vector<Pose2> path;
    for (std::size_t i = 0; i < vehicle.T_world_body().size(); ++i) {
      const Pose2 T = between(vehicle.T_world_body()[0], vehicle.T_world_body()[i]);
      path.push_back(way_m < kLapM ? T : T_map_torn * T);
      if (i + 1 < vehicle.T_world_body().size())
        way_m += distance_m(vehicle.T_world_body()[i].position(), vehicle.T_world_body()[i + 1].position());
    }
    return path;
  }
  [[nodiscard]] KeyframeId keyframe_of(std::size_t scan) const {
    KeyframeId found = run_.chain().all().first_id();
    for (const auto& [keyframe, of_keyframe] : run_.chain().all())
      if (index_of(of_keyframe) <= scan) found = keyframe;
    return found;
  }
  /// The first scan `way_m` behind the start.
  [[nodiscard]] std::size_t scan_at(double way_m) const {
    std::size_t i = 0;
    for (double flown_m = 0.0; flown_m < way_m && i + 1 < vehicle_.T_world_body().size(); ++i)
      flown_m += distance_m(vehicle_.T_world_body()[i].position(), vehicle_.T_world_body()[i + 1].position());
    return i;
  }
  /// Of 6 m each, as they overlap by half, along the first lap.
  [[nodiscard]] std::vector<std::shared_ptr<const Submap>> submaps() const {
    std::vector<std::shared_ptr<const Submap>> all;
    for (double from_m = 0.0; from_m + 6.0 < kLapM; from_m += 3.0)
      all.push_back(std::make_shared<const Submap>(
          build_submap(keyframe_of(scan_at(from_m)), keyframe_of(scan_at(from_m + 6.0)), run_.scans(),
                       run_.chain(), run_.T_local_keyframe(), config_)));
    return all;
  }
  /// What is found of the travel between two ways.
  [[nodiscard]] std::vector<LoopClosure> found(double from_m, double to_m) const {
    return found(from_m, to_m, submaps());
  }
  [[nodiscard]] std::vector<LoopClosure> found(
      double from_m, double to_m, const std::vector<std::shared_ptr<const Submap>>& earlier) const {
    PlaceSearch search(config_, run_.scans(), run_.chain());
    const KeyframeId query = keyframe_of(scan_at(to_m));
    const ScanRange recent{run_.chain().scan_of(keyframe_of(scan_at(from_m))),
                           run_.chain().scan_of(query) + 1};
    search.begin(query, recent, earlier, run_.T_local_keyframe());
    while (search.is_busy()) search.step();
    return search.take_found();
  }
  [[nodiscard]] bool is_right(const LoopClosure& closure) const {
    const std::vector<Pose2>& truth = vehicle_.T_world_body();
    const Pose2 T_true = between(truth[index_of(run_.chain().scan_of(closure.from))],
                                 truth[index_of(run_.chain().scan_of(closure.to))]);
    return static_cast<bool>(poses_near(closure.T_from_to, T_true, 0.4, radians(2.0)));
  }

  static constexpr double kLapM = 38.0;
  BackendConfig config_;
  TestVehicle vehicle_;
  StoredRun run_;
};

TEST_F(PlaceSearchTest, FindsThePlaceWhateverTheDeadReckoningSays) {
  const std::vector<LoopClosure> closures = found(kLapM + 8.0, kLapM + 14.0);
  ASSERT_FALSE(closures.empty());
  EXPECT_TRUE(is_right(*std::ranges::max_element(closures, {}, &LoopClosure::score)));
}

TEST_F(PlaceSearchTest, AnotherStoreyIsNotSearched) {
  EXPECT_TRUE(found(kLapM + 8.0, kLapM + 14.0, one_storey_up(submaps())).empty());
}

TEST_F(PlaceSearchTest, ASubmapThatNoNeighbourCoversIsSearched) {
  const std::vector<std::shared_ptr<const Submap>> all = submaps();
  const std::vector<LoopClosure> closures = found(kLapM + 8.0, kLapM + 14.0, all);
  ASSERT_FALSE(closures.empty());
  const auto has_found = [&](const auto& submap) { return submap->reference == closures.front().from; };
  const auto right = std::ranges::find_if(all, has_found);
  const auto unrelated = right - all.begin() < 5 ? all.back() : all.front();
  EXPECT_FALSE(found(kLapM + 8.0, kLapM + 14.0, {unrelated, *right}).empty());
  EXPECT_FALSE(found(kLapM + 8.0, kLapM + 14.0, {unrelated, *right, unrelated}).empty());
}

TEST_F(PlaceSearchTest, TooFewHitsAreNotSearchedFor) { EXPECT_TRUE(found(kLapM + 8.0, kLapM + 8.2).empty()); }

TEST_F(PlaceSearchTest, AStoppedSearchHasFoundNothing) {
  PlaceSearch search(config_, run_.scans(), run_.chain());
  const KeyframeId query = keyframe_of(scan_at(kLapM + 14.0));
  search.begin(query,
               {run_.chain().scan_of(keyframe_of(scan_at(kLapM + 8.0))), run_.chain().scan_of(query) + 1},
               submaps(), run_.T_local_keyframe());
  ASSERT_TRUE(search.is_busy());
  while (search.is_busy()) search.step();
  search.stop();
  EXPECT_TRUE(search.take_found().empty());
}

}  // namespace
}  // namespace swiftlet
