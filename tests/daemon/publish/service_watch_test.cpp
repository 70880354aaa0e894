// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "daemon/publish/service_watch.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <thread>

#include "daemon/daemon.hpp"
#include "tests/support/notify_socket.hpp"
#include "tests/support/recording_publisher.hpp"
#include "tests/support/scripted_sample_source.hpp"

namespace swiftlet {
namespace {

using std::chrono::milliseconds;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

std::string socket_path() {
  return testing::TempDir() + testing::UnitTest::GetInstance()->current_test_info()->name() + ".sock";
}

/// A watch whose time and progress the test makes.
class ServiceWatchTest : public testing::Test {
 protected:
  /// The messages of a look so much later.
  std::vector<std::string> look_after(milliseconds later) {
    now_ += later;
    watch_.look(now_,
                {.radio_steps = steps_, .input_is_over = is_over_, .statuses = statuses_, .status = status_});
    return manager_socket_.received();
  }

  test::NotifySocket manager_socket_{socket_path(), milliseconds(900)};
  ServiceManager manager_;
  MonotonicTime now_{std::chrono::seconds(100)};
  ServiceWatch watch_{manager_, now_};
  std::uint64_t steps_ = 0;
  bool is_over_ = false;
  std::uint64_t statuses_ = 0;
  DaemonStatus status_;
};

TEST_F(ServiceWatchTest, FeedsTheWatchdogThriceInItsPeriodWhileTheRadioThreadMovesOn) {
  steps_ = 1;
  EXPECT_THAT(look_after(milliseconds(299)), IsEmpty());
  EXPECT_THAT(look_after(milliseconds(1)), ElementsAre("WATCHDOG=1"));
  steps_ = 2;
  EXPECT_THAT(look_after(milliseconds(299)), IsEmpty());
  EXPECT_THAT(look_after(milliseconds(1)), ElementsAre("WATCHDOG=1"));
}

TEST_F(ServiceWatchTest, FeedsTheWatchdogAsSoonAsTheRunBegins) {
  watch_.begin();
  EXPECT_THAT(manager_socket_.received(), ElementsAre("READY=1", "WATCHDOG=1"));
}

TEST_F(ServiceWatchTest, FeedsNoMoreWhenTheRadioThreadStandsStillAndAtOnceWhenItGoesOn) {
  steps_ = 1;
  EXPECT_THAT(look_after(milliseconds(300)), ElementsAre("WATCHDOG=1"));
  for (int i = 0; i < 10; ++i) EXPECT_THAT(look_after(milliseconds(300)), IsEmpty());
  steps_ = 2;
  EXPECT_THAT(look_after(milliseconds(4)), ElementsAre("WATCHDOG=1"));
}

TEST_F(ServiceWatchTest, FeedsThroughTheFinalPassAndSaysOnceThatItStops) {
  is_over_ = true;
  EXPECT_THAT(look_after(milliseconds(4)), ElementsAre("STOPPING=1"));
  EXPECT_THAT(look_after(milliseconds(300)), ElementsAre("WATCHDOG=1"));
  EXPECT_THAT(look_after(milliseconds(300)), ElementsAre("WATCHDOG=1"));
}

TEST_F(ServiceWatchTest, TellsEachStatusInOneLine) {
  statuses_ = 1;
  status_.input.counters.samples = 17;
  EXPECT_THAT(look_after(milliseconds(4)), ElementsAre(testing::StartsWith("STATUS=17 samples")));
  EXPECT_THAT(look_after(milliseconds(4)), IsEmpty());
  statuses_ = 2;
  EXPECT_THAT(look_after(milliseconds(4)), ElementsAre(HasSubstr("STATUS=")));
}

TEST(ServiceManager, IsSilentWhereThereIsNone) {
  const ServiceManager nobody;
  EXPECT_FALSE(nobody.watchdog_period().has_value());
  nobody.report_ready();
  nobody.feed_watchdog();
}

/// Hangs in next(), as a broken driver would, while it is set to.
class HangingSource final : public SampleSource {
 public:
  [[nodiscard]] Result<ReceivedSample> next() override {
    is_hanging.wait(true);
    std::this_thread::sleep_for(milliseconds(1));
    return Error{ErrorCode::kTimeout, "silent"};
  }
  [[nodiscard]] const BeamLayout& beams() const override { return beams_; }
  [[nodiscard]] const SensorModel& sensor() const override { return sensor_; }
  [[nodiscard]] const InputReport& report() const override { return report_; }

  std::atomic<bool> is_hanging{false};

 private:
  BeamLayout beams_ = BeamLayout::multiranger();
  SensorModel sensor_ = SensorModel::crazyflie();
  InputReport report_;
};

std::vector<std::string> received_within(test::NotifySocket& socket, milliseconds duration) {
  std::this_thread::sleep_for(duration);
  return socket.received();
}

TEST(DaemonAsAService, IsReadyIsFedOnAMereSilenceAndNotWhenTheRadioWorkerHangs) {
  test::NotifySocket socket(socket_path(), milliseconds(60));
  const ServiceManager manager;
  HangingSource source;
  SteadyClock clock;
  RecordingPublisher publisher;
  Daemon daemon(Configuration{}, source, clock, InputPolicy{}, publisher);
  daemon.report_to(manager);
  std::stop_source stop;
  std::jthread run([&] { EXPECT_TRUE(daemon.run(stop.get_token()).ok()); });

  const std::vector<std::string> silent = received_within(socket, milliseconds(400));
  EXPECT_EQ(std::count(silent.begin(), silent.end(), "READY=1"), 1);
  EXPECT_GE(std::count(silent.begin(), silent.end(), "WATCHDOG=1"), 3) << "a silent vehicle is polled";
  source.is_hanging = true;
  static_cast<void>(received_within(socket, milliseconds(100)));
  EXPECT_THAT(received_within(socket, milliseconds(400)), Not(Contains("WATCHDOG=1")));
  source.is_hanging = false;
  source.is_hanging.notify_all();
  EXPECT_THAT(received_within(socket, milliseconds(400)), Contains("WATCHDOG=1"));
  stop.request_stop();
  run.join();
  EXPECT_THAT(socket.received(), Contains("STOPPING=1"));
}

}  // namespace
}  // namespace swiftlet
