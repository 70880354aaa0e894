// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "daemon/publish/service_watch.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <functional>
#include <future>
#include <iterator>
#include <string>
#include <thread>
#include <vector>

#include "daemon/daemon.hpp"
#include "tests/support/notify_socket.hpp"
#include "tests/support/recording_publisher.hpp"
#include "tests/support/scripted_sample_source.hpp"

namespace swiftlet {
namespace {

using std::chrono::milliseconds;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::StartsWith;

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
  EXPECT_THAT(look_after(milliseconds(4)), ElementsAre(StartsWith("STATUS=17 samples")));
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
    if (is_told_to_hang) {
      hangs = true;
      hangs.notify_all();
      is_told_to_hang.wait(true);
    }
    std::this_thread::sleep_for(milliseconds(1));
    return Error{ErrorCode::kTimeout, "silent"};
  }
  [[nodiscard]] const BeamLayout& beams() const override { return beams_; }
  [[nodiscard]] const SensorModel& sensor() const override { return sensor_; }
  [[nodiscard]] const InputReport& report() const override { return report_; }

  std::atomic<bool> is_told_to_hang{false};
  std::atomic<bool> hangs{false};

 private:
  BeamLayout beams_ = BeamLayout::multiranger();
  SensorModel sensor_ = SensorModel::crazyflie();
  InputReport report_;
};

using Messages = std::vector<std::string>;

/// What comes until it is enough, within 30 s. A daemon whose messages nobody takes waits.
Messages received_until(test::NotifySocket& socket, const std::function<bool(const Messages&)>& is_enough) {
  Messages all;
  for (int i = 0; i < 30'000 && !is_enough(all); ++i) {
    std::this_thread::sleep_for(milliseconds(1));
    std::ranges::move(socket.received(), std::back_inserter(all));
  }
  EXPECT_TRUE(is_enough(all)) << testing::PrintToString(all);
  return all;
}

std::ptrdiff_t count_of(const char* beginning, const Messages& messages) {
  return std::ranges::count_if(messages, [=](const std::string& m) { return m.starts_with(beginning); });
}

auto at_least(std::ptrdiff_t count, const char* beginning) {
  return [=](const Messages& messages) { return count_of(beginning, messages) >= count; };
}

TEST(DaemonAsAService, IsReadyIsFedOnAMereSilenceAndNotWhenTheRadioWorkerHangs) {
  test::NotifySocket socket(socket_path(), milliseconds(60));
  const ServiceManager manager;
  HangingSource source;
  SteadyClock clock;
  RecordingPublisher publisher;
  Configuration config;
  config.publish.status_period_s = 0.05;
  Daemon daemon(config, source, clock, InputPolicy{}, publisher);
  daemon.report_to(manager);
  std::stop_source stop;
  std::future<Status> run = std::async(std::launch::async, [&] { return daemon.run(stop.get_token()); });

  const Messages silent = received_until(socket, at_least(4, "WATCHDOG=1"));  // it is polled
  EXPECT_EQ(count_of("READY=1", silent), 1);
  source.is_told_to_hang = true;
  source.hangs.wait(false);
  static_cast<void>(socket.received());
  // A look that began before may feed still, and the next for the poll that hangs; each status is a look.
  EXPECT_LE(count_of("WATCHDOG=1", received_until(socket, at_least(5, "STATUS="))), 2);
  source.is_told_to_hang = false;
  source.is_told_to_hang.notify_all();
  static_cast<void>(received_until(socket, at_least(1, "WATCHDOG=1")));
  stop.request_stop();
  static_cast<void>(received_until(socket, at_least(1, "STOPPING=1")));
  const auto has_ended = [&](const Messages&) {
    return run.wait_for(milliseconds(0)) == std::future_status::ready;
  };
  static_cast<void>(received_until(socket, has_ended));
  EXPECT_TRUE(run.get().ok());
}

}  // namespace
}  // namespace swiftlet
