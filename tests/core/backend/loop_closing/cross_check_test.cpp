// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "core/backend/loop_closing/cross_check.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>
#include <vector>

#include "tests/support/loop_corridor.hpp"
#include "tests/support/stored_run.hpp"

namespace swiftlet {
namespace {

/// A lap and the beginning of a second with exact dead reckoning: the frontend's frame is the truth.
class CrossCheckTest : public testing::Test {
 protected:
  static TestVehicle lap_and_a_side() {
    TestVehicle vehicle = vehicle_at_start({}, 7);
    fly_along(vehicle, loop_corridor(), "bcdab");
    return vehicle;
  }
  CrossCheckTest() : run_(lap_and_a_side().samples()) {}

  [[nodiscard]] KeyframeId keyframe_at(double path_m) const {
    std::uint32_t k = 0;
    while (k < index_of(run_.newest()) && run_.chain().path_m(static_cast<KeyframeId>(k)) < path_m) ++k;
    return static_cast<KeyframeId>(k);
  }
  [[nodiscard]] Submap submap_of(double from_m, double to_m) const {
    return build_submap(keyframe_at(from_m), keyframe_at(to_m), run_.scans(), run_.chain(),
                        run_.T_local_keyframe(), config_);
  }
  [[nodiscard]] ScanRange scans_since(double path_m) const {
    return {run_.chain().scan_of(keyframe_at(path_m)), run_.chain().scan_of(run_.newest()) + 1};
  }
  [[nodiscard]] double flown_m() const { return run_.chain().path_m(run_.newest()); }
  [[nodiscard]] Pose2 T_submap_newest(const Submap& submap) const {
    return between(run_.T_local_keyframe()[submap.reference], run_.T_local_keyframe()[run_.newest()]);
  }
  /// By the last six metres, which lead along the side from a to b.
  [[nodiscard]] bool holds(const Submap& submap, const Pose2& T_submap_query) const {
    return CrossCheck(config_, run_.scans(), run_.chain(), scans_since(flown_m() - 6.0), run_.newest(),
                      run_.T_local_keyframe())
        .holds(submap, T_submap_query);
  }

  BackendConfig config_;
  StoredRun run_;
};

TEST_F(CrossCheckTest, HoldsWhereTheSamePlaceWasSeenTwice) {
  const Submap submap = submap_of(4.0, 10.0);
  EXPECT_TRUE(holds(submap, T_submap_newest(submap)));
}

TEST_F(CrossCheckTest, APartialOverlapIsEnough) {
  // The submap leads on around the corner: half of it is ground that the recent travel never saw.
  const Submap submap = submap_of(8.0, 16.0);
  EXPECT_TRUE(holds(submap, T_submap_newest(submap)));
}

TEST_F(CrossCheckTest, WallsThroughFreeSpaceAreRefused) {
  const Submap submap = submap_of(4.0, 10.0);
  const Pose2 T = T_submap_newest(submap);
  EXPECT_FALSE(holds(submap, T * Pose2(0.0, 0.7, 0.0)));          // the corridor's side amid the corridor
  EXPECT_FALSE(holds(submap, T * Pose2(0.0, 0.0, radians(40))));  // walls across it
}

TEST_F(CrossCheckTest, WhereHardlyAnythingOverlapsNothingIsVerified) {
  const Submap submap = submap_of(4.0, 10.0);
  EXPECT_FALSE(holds(submap, T_submap_newest(submap) * Pose2(50.0, 0.0, 0.0)));
}

TEST_F(CrossCheckTest, AWideKernelOfTheSubmapsDoesNotHideFreeSpace) {
  config_.max_kernel_cells = 15;
  const Submap submap = submap_of(4.0, 10.0);
  EXPECT_TRUE(holds(submap, T_submap_newest(submap)));
  EXPECT_FALSE(holds(submap, T_submap_newest(submap) * Pose2(0.0, 0.7, 0.0)));
}

TEST_F(CrossCheckTest, ThinnedHitsLieInTheirFrameOnePerCell) {
  const ScanRange range = scans_since(flown_m() - 2.0);
  const Pose2 T_frame_local(1.0, -2.0, 0.5);
  const auto& T_local = run_.T_local_keyframe();
  const std::vector<Point2> points =
      thinned_hits(run_.scans(), run_.chain(), range, T_local, T_frame_local, 0.1);
  std::set<std::pair<int, int>> cells;
  for (const Point2& p : points)
    cells.emplace(static_cast<int>(std::floor(p.x_m / 0.1)), static_cast<int>(std::floor(p.y_m / 0.1)));
  EXPECT_EQ(cells.size(), points.size());
  std::size_t hits = 0;
  for (ScanId i = range.first; i < range.end; ++i) {
    for (const ScanReturn& beam : run_.scans().returns(i)) {
      if (!beam.is_hit) continue;
      ++hits;
      const Point2 p = T_frame_local * run_.chain().T_w_body(i, T_local) * run_.scans().point_body(beam);
      EXPECT_TRUE(cells.contains(
          {static_cast<int>(std::floor(p.x_m / 0.1)), static_cast<int>(std::floor(p.y_m / 0.1))}));
    }
  }
  EXPECT_GT(hits, points.size());
}

}  // namespace
}  // namespace swiftlet
