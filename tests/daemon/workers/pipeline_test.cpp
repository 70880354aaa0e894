// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "daemon/workers/pipeline.hpp"

#include <gtest/gtest.h>

#include <array>
#include <vector>

#include "daemon/workers/pipeline_queues.hpp"
#include "daemon/workers/radio_worker.hpp"
#include "tests/support/manual_clock.hpp"
#include "tests/support/scripted_sample_source.hpp"

namespace swiftlet {
namespace {

/// Steps until the end; false when that was an error.
bool run_to_end(Pipeline& pipeline) {
  while (true) {
    const Result<bool> more = pipeline.step();
    if (!more) return false;
    if (!*more) return true;
  }
}

TEST(Pipeline, TakesEverySampleThroughAllStages) {
  ScriptedSampleSource source(flight_in_square_room(200, 2.5, 1.5));
  Pipeline pipeline(Configuration{}, source);
  ASSERT_TRUE(run_to_end(pipeline));
  EXPECT_EQ(pipeline.frontend().counters().samples, 200U);
  EXPECT_EQ(pipeline.backend().counters().scans, 200U);
  EXPECT_FALSE(pipeline.map().tiles().empty());
  const std::vector<StageSummary> times = pipeline.stage_times();
  ASSERT_EQ(times.size(), 7U);
  EXPECT_EQ(times[1].name, "frontend");
  EXPECT_EQ(times[1].count, 200U);
  EXPECT_EQ(times[2].name, "backend");
  EXPECT_EQ(times[2].count, 200U);
  EXPECT_EQ(times[3].name, "final_pass");
  EXPECT_EQ(times[3].count, 1U);
  EXPECT_EQ(times[5].name, "pruning");
  EXPECT_EQ(times[6].name, "frame_to_pose");
  EXPECT_EQ(times[6].count, 0U) << "nobody publishes";
  EXPECT_TRUE(pipeline.timing().queues.empty());
}

TEST(Pipeline, TakesOneSampleWithEachStep) {
  ScriptedSampleSource source(flight_in_square_room(3, 2.5, 1.5));
  Pipeline pipeline(Configuration{}, source);
  for (std::uint64_t taken = 1; taken <= 3; ++taken) {
    ASSERT_TRUE(*pipeline.step());
    EXPECT_EQ(pipeline.backend().counters().scans, taken);
  }
  EXPECT_FALSE(*pipeline.step());
}

TEST(Pipeline, TwoRunsOfTheSameInputAgreeToTheLastBit) {
  const auto poses_of_a_run = [] {
    ScriptedSampleSource source(flight_in_square_room(300, 2.5, 1.5));
    Pipeline pipeline(Configuration{}, source);
    EXPECT_TRUE(run_to_end(pipeline));
    std::vector<double> out;
    for (const auto& [id, scan] : pipeline.backend().scans().all()) {
      const Pose2 T_map_body = pipeline.backend().T_map_body(id);
      out.insert(out.end(), {T_map_body.x_m(), T_map_body.y_m(), T_map_body.yaw_rad()});
    }
    return out;
  };
  EXPECT_EQ(poses_of_a_run(), poses_of_a_run());
}

TEST(Pipeline, ARestartIsPublishedAsTheBackendSeesIt) {
  std::vector<RangeSample> flight = flight_in_square_room(300, 2.5, 1.5);
  constexpr std::array<std::size_t, 2> kRestarts{50, 200};  // before and behind the first submap
  for (const std::size_t restart : kRestarts) flight[restart].starts_segment = true;
  ScriptedSampleSource source(flight);
  const ManualClock clock;
  Pipeline pipeline(Configuration{}, source, clock, {});
  std::vector<Tracking> published;
  std::vector<Tracking> seen;
  bool has_lead = false;
  PoseUpdate pose;
  while (published.size() < flight.size()) {
    ASSERT_TRUE(*pipeline.step());
    ASSERT_TRUE(pipeline.queues().to_publisher.poses.consumer().try_pop(pose));
    published.push_back(pose.tracking);
    const TrackingFigures figures = pipeline.backend().tracking();
    seen.push_back(figures.tracking);
    has_lead = has_lead || figures.place_lead != 0.0;
    EXPECT_TRUE(figures.place_lead == 0.0 || figures.places_weighed > 0);
  }
  EXPECT_TRUE(has_lead) << "places are weighed behind the second";
  EXPECT_GT(pipeline.backend().tracking().innovation, 0.0);
  EXPECT_EQ(published[50], Tracking::kTracking);
  EXPECT_EQ(published[200], Tracking::kLost);
  for (const std::size_t restart : kRestarts) EXPECT_EQ(published[restart], seen[restart]) << restart;
}

TEST(Pipeline, SaysWhatEndedTheInputOnceTheFinalPassIsDone) {
  ScriptedSampleSource source(flight_in_square_room(50, 2.5, 1.5), {ErrorCode::kNotFound, "gone"});
  Pipeline pipeline(Configuration{}, source);
  EXPECT_FALSE(run_to_end(pipeline));
  EXPECT_EQ(pipeline.outcome().error().message, "gone");
  EXPECT_EQ(pipeline.backend().counters().scans, 50U);
  EXPECT_FALSE(pipeline.map().tiles().empty()) << "what came before is drawn";
}

TEST(Pipeline, AnInputWithoutSamplesEndsCleanly) {
  ScriptedSampleSource source({});
  Pipeline pipeline(Configuration{}, source);
  EXPECT_TRUE(run_to_end(pipeline));
  EXPECT_TRUE(pipeline.map().tiles().empty());
}

}  // namespace
}  // namespace swiftlet
