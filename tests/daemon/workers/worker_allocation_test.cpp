// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include <gtest/gtest.h>

#include <memory>

#include "daemon/workers/frontend_worker.hpp"
#include "daemon/workers/pipeline_queues.hpp"
#include "daemon/workers/radio_worker.hpp"
#include "tests/support/allocation_counter.hpp"
#include "tests/support/manual_clock.hpp"
#include "tests/support/scripted_sample_source.hpp"

namespace swiftlet {
namespace {

TEST(WorkerAllocation, RadioAndFrontendTakeNothingFromTheHeapOverAWholeFlight) {
  if (!test::counts_allocations()) GTEST_SKIP() << "sanitizers bring a malloc of their own";
  ManualClock clock;
  ScriptedSampleSource source(flight_in_square_room(1000, 2.5, 1.5));
  Frontend frontend(FrontendConfig{}, source.sensor(), source.beams());
  const auto queues = std::make_unique<PipelineQueues>();
  StageTimes times;
  RadioWorker radio(source, clock, {.rate = 1.0, .refuses_when_full = true}, queues->samples.producer(),
                    queues->to_publisher.input_outlet(), times.input);
  FrontendWorker worker(frontend, clock, queues->samples.consumer(), queues->steps.producer(),
                        queues->correction, queues->to_publisher.frontend_outlet(),
                        BeamReadings::of(source.beams(), source.sensor()), times.frontend);
  auto steps = queues->steps.consumer();
  FrontendStep taken;
  std::size_t allocations = 0;
  for (int i = 0; i < 1000; ++i) {
    clock.sleep_until(radio.due());
    queues->correction.store(
        {.keyframe = {}, .T_map_local = Pose2(), .version = static_cast<std::uint32_t>(i)});
    const test::AllocationCounter counter;
    const StepResult received = radio.step();
    const StepResult processed = worker.step();
    allocations += counter.count();
    ASSERT_TRUE(received != StepResult::kFinished && processed != StepResult::kBlocked);
    while (steps.try_pop(taken)) {
    }
  }
  EXPECT_EQ(allocations, 0U);
  EXPECT_GE(frontend.counters().samples, 500U) << "held back until due, each sample takes two steps at most";
}

}  // namespace
}  // namespace swiftlet
