// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "tools/record_command.hpp"

#include <spdlog/fmt/fmt.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <memory>
#include <stop_token>
#include <thread>
#include <type_traits>
#include <utility>

#include "core/base/latest_value.hpp"
#include "core/base/time.hpp"
#include "daemon/publish/status_log.hpp"
#include "daemon/recording/recorder.hpp"
#include "daemon/recording/recording_files.hpp"
#include "daemon/recording/recording_plan.hpp"
#include "daemon/system/signal_watcher.hpp"
#include "firmware_link/input/input_uri.hpp"
#include "firmware_link/input/open_sample_source.hpp"
#include "firmware_link/session/vehicle_event.hpp"
#include "tools/progress_bar.hpp"

namespace swiftlet {
namespace {

using WallClock = std::chrono::steady_clock;

constexpr std::chrono::milliseconds kLook{100};
constexpr int kLooksPerLine = 10;
constexpr std::chrono::seconds kChangesEvery{1};

/// What the thread that listens hands to the one that shows.
struct Received {
  std::uint64_t samples = 0;
  std::uint64_t gaps = 0;
  HostTime first{};  ///< stamps of samples
  HostTime latest{};
};
static_assert(std::is_trivially_copyable_v<Received>);

double rate_hz(std::uint64_t samples, Duration span) {
  return span > Duration::zero() ? static_cast<double>(samples) / to_seconds(span) : 0.0;
}
/// From the first sample to the last.
double mean_rate_hz(const Received& received) {
  return received.samples > 1 ? rate_hz(received.samples - 1, received.latest - received.first) : 0.0;
}

/// The running line, in a thread of its own: a terminal that is held must not hold the radio.
class RunningLine {
 public:
  RunningLine(LatestValue<Received>& received, const Recorder& recorder) {
    if (::isatty(::fileno(stderr)) != 1) return;
    thread_ =
        std::jthread([&received, &recorder](const std::stop_token& over) { show(received, recorder, over); });
  }

 private:
  static void show(LatestValue<Received>& newest, const Recorder& recorder, const std::stop_token& over) {
    Received received;
    Received shown;
    for (int look = 1; !over.stop_requested(); ++look) {
      std::this_thread::sleep_for(kLook);
      if (look % kLooksPerLine != 0) continue;
      static_cast<void>(newest.load_if_new(received));
      const double rate = shown.samples > 0
                              ? rate_hz(received.samples - shown.samples, received.latest - shown.latest)
                              : mean_rate_hz(received);
      shown = received;
      std::fputs(
          (kBackToEmptyLine + recording_summary(received.samples, rate, received.gaps, recorder.bytes()))
              .c_str(),
          stderr);
      std::fflush(stderr);
    }
    std::fputs(kBackToEmptyLine, stderr);
    std::fflush(stderr);
  }

  std::jthread thread_;
};

/// Listens to a source and keeps count.
class Listener {
 public:
  Listener(SampleSource& source, LatestValue<Received>& newest) : source_(source), newest_(newest) {}

  /// While `may_go_on`. Errors: what ended the input before its time.
  template <typename Condition>
  Status listen(Condition may_go_on) {
    while (may_go_on(std::as_const(received_))) {
      const Result<ReceivedSample> next = source_.next();
      print_news();
      if (WallClock::now() >= next_look_) print_changes();
      if (!next && next.error().code == ErrorCode::kEndOfRecording) break;
      if (!next && next.error().code != ErrorCode::kTimeout) return next.error();
      if (!next) continue;
      received_.latest = next->sample.stamp;
      if (received_.samples == 0) received_.first = received_.latest;
      ++received_.samples;
      received_.gaps = source_.report().counters.gaps;
      newest_.store(received_);
    }
    print_changes();
    return {};
  }
  [[nodiscard]] const Received& received() const { return received_; }

 private:
  void print_news() {
    const InputReport& report = source_.report();
    for (; notes_ < report.notes.size(); ++notes_) print_line("note", report.notes[notes_]);
    while (const std::optional<VehicleEvent> event = source_.take_event())
      print_line(is_warning(*event) ? "warning" : "note", describe(*event));
    notes_ = report.notes.size();  // a warning becomes a note of the report, too
    for (; problems_ < report.problems.size(); ++problems_) print_line("problem", report.problems[problems_]);
  }
  /// As swiftletd does, and as often.
  void print_changes() {
    next_look_ = WallClock::now() + kChangesEvery;
    InputStatus now;
    now.counters = source_.report().counters;
    now.live = source_.live_status().value_or(LiveStatus{});
    for (const InputNews& news : input_news(printed_, now))
      print_line(news.is_warning ? "warning" : "note", news.text);
    printed_ = now;
  }
  static void print_line(const char* kind, const std::string& text) {
    const char* start = ::isatty(::fileno(stderr)) == 1 ? kBackToEmptyLine : "";
    std::fprintf(stderr, "%sswiftlet: %s: %s\n", start, kind, text.c_str());
  }

  SampleSource& source_;
  LatestValue<Received>& newest_;
  Received received_;
  InputStatus printed_;
  WallClock::time_point next_look_{};
  std::size_t notes_ = 0;  // printed so far
  std::size_t problems_ = 0;
};

Result<RecordingPlan> plan_for(const RecordCommand& command) {
  if (command.file.empty())
    return Error{ErrorCode::kInvalidInput, "-o names no file; name the recording, as in -o flight.pcap"};
  const Result<InputUri> input = parse_input_uri(command.input);
  if (!input) return input.error();
  const HostTime now(std::chrono::system_clock::now().time_since_epoch());
  const RecordingWish wish{.asked = true, .refused = false, .file = command.file};
  const Result<std::optional<RecordingPlan>> plan = plan_recording(*input, wish, RecordConfig{}, now);
  if (!plan) return plan.error();
  return **plan;
}

/// Listens while the recorder's thread writes; all is on the disk afterwards.
Status listen_and_record(const RecordCommand& command, const std::stop_token& stop, Recorder& recorder,
                         Listener& listener, LatestValue<Received>& newest) {
  const RecorderThread writer(recorder);
  const RunningLine line(newest, recorder);
  const WallClock::time_point began = WallClock::now();
  return listener.listen([&](const Received& received) {
    const Duration elapsed = std::max<Duration>(WallClock::now() - began, received.latest - received.first);
    return !stop.stop_requested() && !recorder.failed() &&
           !(command.seconds && elapsed >= from_seconds(*command.seconds));
  });
}

}  // namespace

std::string recording_summary(std::uint64_t samples, double rate_hz, std::uint64_t gaps,
                              std::uint64_t bytes) {
  return fmt::format("{} samples, {:.1f} Hz, {} gaps, {}", samples, rate_hz, gaps, size_text(bytes));
}

Status run_record_command(const RecordCommand& command) {
  const SignalWatcher signals;  // before the threads
  const Result<RecordingPlan> plan = plan_for(command);
  if (!plan) return plan.error();
  std::string trouble;  // of the recorder's thread until that has ended
  const RecorderVoice voice{
      .note = [](const std::string&) {},
      .problem = [&trouble](const std::string& text) { trouble += (trouble.empty() ? "" : "; ") + text; }};
  const Result<std::unique_ptr<Recorder>> recorder = Recorder::open(*plan, voice);
  if (!recorder) return recorder.error();
  SampleSourceOptions options;
  options.recording = &(*recorder)->sink();
  const Result<std::unique_ptr<SampleSource>> source = open_sample_source(command.input, options);
  if (!source) return source.error();

  LatestValue<Received> newest;
  Listener listener(**source, newest);
  Status received = listen_and_record(command, signals.token(), **recorder, listener, newest);
  if (!trouble.empty()) return Error{ErrorCode::kOutOfSpace, trouble};
  if (!received) return received;
  const Received& total = listener.received();
  if (total.samples == 0)
    return Error{ErrorCode::kInvalidInput,
                 command.input + ": not one sample was received; is the vehicle on?"};
  std::printf("%s: %s\n",
              recording_summary(total.samples, mean_rate_hz(total), total.gaps, (*recorder)->bytes()).c_str(),
              command.file.c_str());
  return {};
}

}  // namespace swiftlet
