// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "daemon/publish/status_log.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <spdlog/sinks/ostream_sink.h>
#include <spdlog/spdlog.h>

#include <memory>
#include <sstream>

namespace swiftlet {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

class StatusLog : public testing::Test {
 protected:
  StatusLog() {
    auto logger =
        std::make_shared<spdlog::logger>("test", std::make_shared<spdlog::sinks::ostream_sink_mt>(text_));
    logger->set_level(spdlog::level::warn);
    spdlog::set_default_logger(std::move(logger));
  }
  std::string logged() const { return text_.str(); }

 private:
  std::ostringstream text_;
};

TEST_F(StatusLog, IsSilentWhileAllGoesWell) {
  DaemonStatus now;
  now.input.counters.samples = 10;
  now.input.counters.segments = 1;  // the first beginning is none anew
  log_changes(DaemonStatus{}, now);
  EXPECT_THAT(logged(), IsEmpty());
}

TEST_F(StatusLog, TellsOfASegmentBeforeTheFirstStatusToo) {
  DaemonStatus now;
  now.input.counters.segments = 2;
  log_changes(DaemonStatus{}, now);
  EXPECT_THAT(logged(), HasSubstr("new segments (silence, restart or reset): 1 more"));
}

TEST_F(StatusLog, NamesWhatWasRefusedAndWhereAndHowOften) {
  DaemonStatus now;
  now.queues[0].name = "samples";
  now.queues[0].refused = 3;
  now.backend.solver_failures = 2;
  log_changes(DaemonStatus{}, now);
  EXPECT_THAT(logged(), HasSubstr("queue of samples: full, 3 refused"));
  EXPECT_THAT(logged(), HasSubstr("solver failures: 2 more"));
}

TEST_F(StatusLog, TellsOfRollBacksInAVerboseLogAlone) {
  DaemonStatus now;
  now.frontend.batches_rolled_back = 2;
  log_changes(DaemonStatus{}, now);
  EXPECT_THAT(logged(), IsEmpty());
  spdlog::set_level(spdlog::level::debug);
  log_changes(DaemonStatus{}, now);
  EXPECT_THAT(logged(), HasSubstr("batches rolled back: 2 more"));
}

TEST_F(StatusLog, SaysHowTheLinkStandsWhenThatChanges) {
  DaemonStatus before;
  before.input.live.link.condition = LinkCondition::kConnected;
  DaemonStatus now = before;
  log_changes(before, now);
  EXPECT_THAT(logged(), IsEmpty());
  now.input.live.link.condition = LinkCondition::kDeviceBusy;
  log_changes(before, now);
  EXPECT_THAT(logged(), HasSubstr("another program"));
}

TEST_F(StatusLog, PutsEventsIntoWords) {
  log_event({VehicleEvent::Kind::kNoMultiranger, 0});
  EXPECT_THAT(logged(), HasSubstr("no Multiranger deck"));
}

TEST_F(StatusLog, SaysEachThingOnce) {
  DaemonStatus now;
  now.backend.solver_failures = 2;
  log_changes(now, now);
  EXPECT_THAT(logged(), Not(HasSubstr("solver")));
}

TEST_F(StatusLog, TellsAClosureFoundFromOneDropped) {
  spdlog::set_level(spdlog::level::debug);
  ClosureUpdate update;
  update.closure.from = KeyframeId{4};
  update.closure.to = KeyframeId{90};
  log_closure(update);
  EXPECT_THAT(logged(), HasSubstr("loop closed between keyframes 4 and 90"));
  update.closure.dropped = true;
  log_closure(update);
  EXPECT_THAT(logged(), HasSubstr("loop dropped between keyframes 4 and 90"));
}

TEST(TrackingNews, TellAPilotOfEachChangeOnce) {
  TrackingFigures good;
  EXPECT_FALSE(tracking_news(good, good).has_value());
  TrackingFigures doubted;
  doubted.tracking = Tracking::kUncertain;
  doubted.contradicting_share = 0.34;
  const auto doubt = tracking_news(good, doubted);
  ASSERT_TRUE(doubt.has_value());
  EXPECT_TRUE(doubt->is_warning);
  EXPECT_THAT(doubt->text, HasSubstr("34 % of the last returns contradict"));
  TrackingFigures lost;
  lost.tracking = Tracking::kLost;
  EXPECT_TRUE(tracking_news(good, lost)->is_warning);
  EXPECT_FALSE(tracking_news(lost, good)->is_warning);
  TrackingFigures weighing;
  weighing.tracking = Tracking::kRelocalizing;
  weighing.places_weighed = 12;
  EXPECT_THAT(tracking_news(lost, weighing)->text, HasSubstr("12 places"));
}

}  // namespace
}  // namespace swiftlet
