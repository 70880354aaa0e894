// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <thread>

#include "core/base/result.hpp"
#include "core/base/time.hpp"
#include "daemon/recording/recording_plan.hpp"
#include "daemon/workers/pipeline_queues.hpp"
#include "daemon/workers/worker.hpp"
#include "firmware_link/capture/capture_writer.hpp"
#include "firmware_link/link/frame_sink.hpp"
#include "firmware_link/session/log_session.hpp"

namespace swiftlet {

/// Where the recorder's messages for people go; called on its thread (and on that which starts it).
struct RecorderVoice {
  std::function<void(const std::string&)> note;
  std::function<void(const std::string&)> problem;
};

/// The radio thread's end of a recording: hands on every frame but null packets, which carry nothing. Does
/// not wait (unless created for a source that can) and does not allocate.
class RecordingSink final : public FrameSink {
 public:
  RecordingSink(RecordingQueue::Producer frames, bool source_can_wait)
      : frames_(frames), source_can_wait_(source_can_wait) {}
  void take(const LinkFrame& frame) noexcept override;
  /// Nothing more will come. Not while another thread is in take().
  void close() noexcept { frames_.close(); }

 private:
  RecordingQueue::Producer frames_;
  bool source_can_wait_;
};

/// Writes what its sink is given into captures that replay to the same samples. Every file can be read on its
/// own: where one is continued in another, that begins with what was learnt of the session so far. A disk
/// that is full or fails ends the recording with one message, never its caller. One thread at a time for
/// step(), any for the counts; allocates.
class Recorder {
 public:
  /// Creates the first file. Errors: kInvalidInput, kOutOfSpace: it cannot be; one line with path and reason.
  [[nodiscard]] static Result<std::unique_ptr<Recorder>> open(RecordingPlan plan, RecorderVoice voice);
  ~Recorder();
  Recorder(const Recorder&) = delete;
  Recorder& operator=(const Recorder&) = delete;

  /// For the radio thread; lives as long as the recorder.
  [[nodiscard]] RecordingSink& sink() { return sink_; }
  /// Writes what has come, down to the operating system. kIdle: nothing had. kFinished: the sink was closed
  /// and all is on the disk.
  StepResult step();

  /// The file being written. Not while another thread steps.
  [[nodiscard]] const std::string& path() const { return path_; }
  /// Bytes of all its files so far.
  [[nodiscard]] std::uint64_t bytes() const { return bytes_.load(std::memory_order_relaxed); }
  /// The recording has ended before its time.
  [[nodiscard]] bool failed() const { return failed_.load(std::memory_order_relaxed); }

 private:
  Recorder(RecordingPlan plan, RecorderVoice voice);
  [[nodiscard]] Status open_part();
  [[nodiscard]] Result<CaptureWriter> create_file();
  void make_room();
  void record(const LinkFrame& frame);
  void note_exchange(const LinkFrame& frame);
  [[nodiscard]] bool must_change_file_before(const LinkFrame& frame) const;
  [[nodiscard]] Status change_file(HostTime at);
  void tell_refused();
  void stop(const Error& error);
  void finish();
  void drop_if_nothing_was_received();

  RecordingPlan plan_;
  RecorderVoice voice_;
  std::unique_ptr<RecordingQueue> queue_ = std::make_unique<RecordingQueue>();
  RecordingSink sink_;
  RecordingQueue::Consumer frames_;
  std::optional<CaptureWriter> writer_;  // none: the recording has ended
  std::string path_;
  int part_ = 0;
  LogSession session_;         // what the next file must begin with
  bool awaits_reply_ = false;  // of the log's control channel: not to be torn apart
  bool vehicle_received_ = false;
  bool refusal_told_ = false;
  std::uint64_t packets_ = 0;
  std::uint64_t closed_bytes_ = 0;  // of the parts before this one
  std::atomic<std::uint64_t> bytes_{0};
  std::atomic<bool> failed_{false};
};

/// A thread named "recorder" that runs one. Looks for frames twenty times a second: a killed process loses
/// no more than that of its recording.
class RecorderThread {
 public:
  explicit RecorderThread(Recorder& recorder);
  /// Closes the sink (no other thread may be in take() any more) and waits until all is on the disk.
  ~RecorderThread();
  RecorderThread(const RecorderThread&) = delete;
  RecorderThread& operator=(const RecorderThread&) = delete;

 private:
  Recorder& recorder_;
  std::jthread thread_;
};

}  // namespace swiftlet
