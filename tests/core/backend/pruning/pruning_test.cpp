// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "core/backend/pruning/pruning.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <functional>
#include <string>

#include "core/backend/refinement/point_to_line_factor.hpp"
#include "core/backend/store/traversal.hpp"
#include "tests/support/loop_corridor.hpp"
#include "tests/support/stored_run.hpp"

namespace swiftlet {
namespace {

const double kOtherTimeM = BackendConfig().min_travel_between_m;

std::vector<RangeSample> laps(int count) {
  TestVehicle vehicle = vehicle_at_start({}, 5);
  for (int lap = 0; lap < count; ++lap) fly_along(vehicle, loop_corridor(), "bcda");
  return vehicle.samples();
}

/// Flown once for all tests: with exact odometry, so the frontend's frame is the map.
const StoredRun& ten_laps() {
  static const StoredRun kRun(laps(10));
  return kRun;
}

Pruning plan(const StoredRun& run, std::size_t scans_wanted, std::optional<KeyframeId> first_recent = {}) {
  const BackendConfig config;
  return Pruner(config, run.scans(), run.chain())
      .plan(run.T_local_keyframe(), first_recent.value_or(run.newest()), scans_wanted);
}

double lap_of(const StoredRun& run, KeyframeId keyframe) {
  return run.chain().path_m(keyframe) / run.chain().path_m(run.newest()) * 10.0;
}

TEST(Pruning, TakesTheLapsBetweenTheOldestAndTheNewest) {
  const Pruning all = plan(ten_laps(), 1'000'000);
  ASSERT_GT(all.scan_count, ten_laps().scans().size() / 3);
  EXPECT_LT(all.scan_count, ten_laps().scans().size());
  for (const PrunedTraversal& traversal : all.traversals) {
    EXPECT_GT(lap_of(ten_laps(), traversal.keyframes.first), 1.0);
    EXPECT_LT(lap_of(ten_laps(), traversal.keyframes.end), 9.0);
  }
}

TEST(Pruning, LeavesWhatWasSeenOnceOrTwice) {
  EXPECT_TRUE(plan(StoredRun(laps(1)), 1'000'000).empty());
  EXPECT_TRUE(plan(StoredRun(laps(2)), 1'000'000).empty());
}

TEST(Pruning, LeavesALookIntoARoomThatNoOtherPassSaw) {
  TestVehicle vehicle = vehicle_at_start({}, 5);
  for (int lap = 0; lap < 4; ++lap) fly_along(vehicle, loop_corridor(), "bcda");
  const auto first = make_id<ScanId>(vehicle.samples().size());
  // The same flight through another building, once: nobody else has seen it.
  fly_along(vehicle, loop_corridor({100.0, 0.0}), "");
  const TextRoom elsewhere = loop_corridor({100.0, 0.0});
  vehicle.carry_to(elsewhere, Pose2(elsewhere.place('a').x_m, elsewhere.place('a').y_m, 0.0));
  for (const char place : std::string("bc")) vehicle.fly_to(elsewhere, elsewhere.place(place));
  const auto end = make_id<ScanId>(vehicle.samples().size());
  vehicle.carry_to(loop_corridor(),
                   Pose2(loop_corridor().place('a').x_m, loop_corridor().place('a').y_m, 0.0));
  for (int lap = 0; lap < 5; ++lap) fly_along(vehicle, loop_corridor(), "bcda");

  // Poses as they truly are, for dead reckoning does not know where it was carried.
  const StoredRun run(vehicle.samples());
  KeyframePoses T_map_keyframe;
  for (const ScanId scan : run.chain().all().values())
    T_map_keyframe.push_back(vehicle.T_world_body()[index_of(scan)]);
  const BackendConfig config;
  const Pruning all = Pruner(config, run.scans(), run.chain()).plan(T_map_keyframe, run.newest(), 1'000'000);
  ASSERT_FALSE(all.empty());
  for (const PrunedTraversal& traversal : all.traversals)
    EXPECT_TRUE(traversal.scans.end <= first || traversal.scans.first >= end)
        << index_of(traversal.scans.first);
}

TEST(Pruning, TakesTravelThatMetNoWall) {
  std::vector<RangeSample> samples = laps(10);
  for (RangeSample& sample : samples)
    if (sample.T_odom_body.x_m() > 3.0 && sample.T_odom_body.x_m() < 7.0)
      for (RangeStatus& status : sample.status) status = RangeStatus::kNoReturn;
  const StoredRun run(samples);
  const auto has_met_a_wall = [&](const PrunedTraversal& traversal) {
    return std::ranges::any_of(run.scans().all().values(traversal.scans), [&](const StoredScan& scan) {
      return std::ranges::any_of(run.scans().returns(scan), &ScanReturn::is_hit);
    });
  };
  const Pruning all = plan(run, 1'000'000);
  EXPECT_GT(std::ranges::count_if(all.traversals, std::not_fn(has_met_a_wall)), 6);
}

/// Ten laps, each on the storey that `storey_of` gives.
template <typename StoreyOf>
std::vector<RangeSample> laps_in_a_house(StoreyOf storey_of) {
  std::vector<RangeSample> samples = laps(10);
  for (std::size_t i = 0; i < samples.size(); ++i)
    samples[i].storey = make_id<StoreyId>(storey_of(10 * i / samples.size()));
  return samples;
}

TEST(Pruning, VisitsOfAnotherStoreyAreNone) {
  // Of these, were they on one storey, the first would be an anchor of the second, which is one of many.
  const StoredRun run(laps_in_a_house([](std::size_t lap) { return lap == 1 || lap == 5 ? 1U : 0U; }));
  const Pruning all = plan(run, 1'000'000);
  ASSERT_FALSE(all.empty());
  for (const PrunedTraversal& traversal : all.traversals)
    EXPECT_EQ(run.scans()[traversal.scans.first].storey, StoreyId{}) << "the two laps above stay";
}

TEST(Pruning, AnchorsAreOnTheSameStorey) {
  const StoredRun run(laps_in_a_house([](std::size_t lap) { return lap % 2; }));
  BackendConfig config;
  config.tuning.pruning.kept_per_tile = 1;
  const Pruning all =
      Pruner(config, run.scans(), run.chain()).plan(run.T_local_keyframe(), run.newest(), 1'000'000);
  std::array<int, 2> of_storey{};
  for (const PrunedTraversal& traversal : all.traversals) {
    const StoreyId storey = run.chain().storey(traversal.keyframes.first + 1);
    EXPECT_EQ(run.chain().storey(traversal.anchor), storey);
    ++of_storey[index_of(storey)];
  }
  EXPECT_GT(of_storey[0], 5);
  EXPECT_GT(of_storey[1], 5);
}

TEST(Pruning, TakesWholeTraversalsAndNoMoreThanAskedFor) {
  const Pruning some = plan(ten_laps(), 200);
  EXPECT_GE(some.scan_count, 200U);
  EXPECT_LT(some.scan_count, 300U);
  std::size_t scans = 0;
  for (const PrunedTraversal& traversal : some.traversals) {
    EXPECT_EQ(traversal.keyframes, keyframes_of(traversal_of(traversal.keyframes.first)));
    EXPECT_EQ(traversal.scans, ten_laps().chain().scans_of(traversal.keyframes));
    scans += ten_laps().scans().all().count(traversal.scans);
    EXPECT_TRUE(some.keyframes.contains(traversal.keyframes.first));
  }
  EXPECT_EQ(some.scan_count, scans);
}

TEST(Pruning, AnchorsAreNearFromAnotherTimeAndStay) {
  const Pruning all = plan(ten_laps(), 1'000'000);
  ASSERT_FALSE(all.empty());
  for (const PrunedTraversal& traversal : all.traversals) {
    EXPECT_FALSE(all.keyframes.contains(traversal.anchor));
    const KeyframeId first = traversal.keyframes.first;
    const Pose2 apart =
        between(ten_laps().T_local_keyframe()[first], ten_laps().T_local_keyframe()[traversal.anchor]);
    EXPECT_LT(std::hypot(apart.x_m(), apart.y_m()), 4.0);
    EXPECT_GT(std::abs(ten_laps().chain().path_m(first) - ten_laps().chain().path_m(traversal.anchor)),
              kOtherTimeM - 2.0);
  }
}

/// Motions alone, each of which errs by so much in every direction.
PoseGraph graph_of(const StoredRun& run, double step_sigma_m) {
  PoseGraph graph;
  graph.T_map_keyframe = run.T_local_keyframe();
  for (const auto& [to, T_map_to] : run.T_local_keyframe()) {
    if (to == run.T_local_keyframe().first_id()) continue;
    RelativePoseFactor<KeyframeId> motion{to - 1, to, between(run.T_local_keyframe()[to - 1], T_map_to)};
    motion.information.diagonal() = Eigen::Vector3d(1.0, 1.0, 100.0) / (step_sigma_m * step_sigma_m);
    graph.factors.push_back(motion);
  }
  return graph;
}

TEST(Pruning, ATieIsNoTighterThanTheGraph) {
  const Pruning pruning = plan(ten_laps(), 300);
  const PruningTuning least;
  for (const double step_sigma_m : {1e-3, 0.2}) {
    const PoseGraph graph = graph_of(ten_laps(), step_sigma_m);
    for (const RelativePoseFactor<KeyframeId>& tie : ties_around(pruning, ten_laps().scans(), graph)) {
      const double steps = std::abs(static_cast<double>(index_of(tie.to)) - index_of(tie.from));
      const double sigma_m = std::sqrt(tie.information.inverse()(0, 0));
      EXPECT_GE(sigma_m, std::max(least.tie_sigma_m, step_sigma_m * std::sqrt(steps)) - 1e-9);
    }
  }
}

TEST(Pruning, AHoleThatGrowsIsTiedAtItsNewEndOnly) {
  const Pruning begun = plan(ten_laps(), 300);
  ASSERT_FALSE(begun.empty());
  const IdRange<KeyframeId> hole = *begun.keyframes.begin();
  PoseGraph graph = graph_of(ten_laps(), 0.01);
  const auto ties = ties_around(begun, ten_laps().scans(), graph);
  ASSERT_EQ(ties.size(), 2 * static_cast<std::size_t>(begun.keyframes.end() - begun.keyframes.begin()));
  EXPECT_EQ(ties[0].to, hole.first - 1);
  EXPECT_EQ(ties[1].to, hole.end);

  ScanStore scans = ten_laps().scans();
  scans.erase(begun.scans);
  graph.T_map_keyframe.erase(begun.keyframes);
  graph.factors.erase_if([&](const RelativePoseFactor<KeyframeId>& motion) {
    return begun.keyframes.contains(motion.from) || begun.keyframes.contains(motion.to);
  });
  for (const RelativePoseFactor<KeyframeId>& tie : ties) graph.factors.push_back(tie);
  const IdRange<KeyframeId> next{hole.end, hole.end + kKeyframesPerTraversal};
  ASSERT_FALSE(begun.keyframes.contains(next.end)) << "not the next hole's";
  Pruning grown;
  grown.add({next, ten_laps().chain().scans_of(next), begun.traversals.front().anchor}, ten_laps().scans());
  const auto more = ties_around(grown, scans, graph);
  ASSERT_EQ(more.size(), 1U);
  EXPECT_EQ(more.front().to, next.end);
}

TEST(Pruning, LeavesAnchorsOfEarlierOnesAndWhatIsRecent) {
  const Pruning before = plan(ten_laps(), 1'000'000);
  const KeyframeId kept = before.traversals[3].keyframes.first + 1;
  Pruning earlier;
  earlier.add({{}, {}, kept}, ten_laps().scans());
  const BackendConfig config;
  Pruner pruner(config, ten_laps().scans(), ten_laps().chain());
  pruner.keep_anchors(earlier);
  EXPECT_TRUE(before.keyframes.contains(kept));
  EXPECT_FALSE(
      pruner.plan(ten_laps().T_local_keyframe(), ten_laps().newest(), 1'000'000).keyframes.contains(kept));
  const KeyframeId recent = before.traversals[before.traversals.size() / 2].keyframes.first;
  for (const PrunedTraversal& traversal : plan(ten_laps(), 1'000'000, recent).traversals)
    EXPECT_LE(traversal.keyframes.end, recent);
}

TEST(Pruning, IsDueOnceThereAreMoreScansThanAllowed) {
  BackendConfig config;
  const auto count = static_cast<int>(ten_laps().scans().size());
  config.max_scans = count + 1;
  const KeyframeId end = ten_laps().chain().all().end_id();
  EXPECT_TRUE(Pruner(config, ten_laps().scans(), ten_laps().chain())
                  .next(ten_laps().T_local_keyframe(), end)
                  .empty());
  config.max_scans = count - 10;
  Pruner pruner(config, ten_laps().scans(), ten_laps().chain());
  const Pruning pruning = pruner.next(ten_laps().T_local_keyframe(), end);
  EXPECT_GE(pruning.scan_count, 10U + static_cast<std::size_t>(count) / 21);
  EXPECT_TRUE(Pruner(config, ten_laps().scans(), ten_laps().chain())
                  .next(ten_laps().T_local_keyframe(), pruning.traversals.front().keyframes.first)
                  .empty())
      << "all of it lies behind what is in use";
}

TEST(Pruning, WaitsForAsMuchAsIsPrunedAtATimeWhereItMay) {
  BackendConfig config;
  const auto count = static_cast<int>(ten_laps().scans().size());
  const KeyframeId end = ten_laps().chain().all().end_id();
  const auto next = [&](int max_scans, bool may_wait) {
    config.max_scans = max_scans;
    return Pruner(config, ten_laps().scans(), ten_laps().chain())
        .next(ten_laps().T_local_keyframe(), end, may_wait);
  };
  EXPECT_FALSE(next(count - 10, false).empty());
  EXPECT_TRUE(next(count - 10, true).empty());
  EXPECT_FALSE(next(count - count / 15, true).empty());
}

TEST(Pruning, IsNotDueForAVehicleThatStandsLanded) {
  std::vector<RangeSample> samples = laps(10);
  const std::size_t flown = samples.size();
  for (std::size_t i = 0; i < flown; ++i) {
    RangeSample landed = samples.back();
    landed.sequence += 1;
    landed.measured_at += std::chrono::milliseconds(100);
    landed.stamp += std::chrono::milliseconds(100);
    landed.status.fill(RangeStatus::kInvalid);
    samples.push_back(landed);
  }
  const StoredRun run(samples);
  ASSERT_GT(run.scans().size(), flown);
  BackendConfig config;
  config.max_scans = static_cast<int>(flown) + 1;
  const KeyframeId end = run.chain().all().end_id();
  EXPECT_TRUE(Pruner(config, run.scans(), run.chain()).next(run.T_local_keyframe(), end).empty());
}

}  // namespace
}  // namespace swiftlet
