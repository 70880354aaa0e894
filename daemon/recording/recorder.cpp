// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "daemon/recording/recorder.hpp"

#include <pthread.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <system_error>
#include <utility>

#include "daemon/recording/recording_files.hpp"
#include "firmware_link/capture/session_preamble.hpp"
#include "firmware_link/crtp/crtp_packet.hpp"
#include "firmware_link/link/request_queue.hpp"

namespace swiftlet {
namespace {

constexpr std::chrono::milliseconds kRoomWait{1};
constexpr std::chrono::milliseconds kTick{50};
constexpr std::size_t kFramesPerStep = 1024;
constexpr int kMaxParts = 10'000;

}  // namespace

void RecordingSink::take(const LinkFrame& frame) noexcept {
  if (frame.size == 0 || is_null_packet(frame.packet())) return;
  while (source_can_wait_ && !frames_.has_room()) std::this_thread::sleep_for(kRoomWait);
  static_cast<void>(frames_.try_push(frame));  // what is refused is counted
}

Result<std::unique_ptr<Recorder>> Recorder::open(RecordingPlan plan, RecorderVoice voice) {
  std::unique_ptr<Recorder> recorder(new Recorder(std::move(plan), std::move(voice)));
  const Status opened = recorder->open_part();
  if (!opened) return opened.error();
  return recorder;
}

Recorder::Recorder(RecordingPlan plan, RecorderVoice voice)
    : plan_(std::move(plan)),
      voice_(std::move(voice)),
      sink_(queue_->producer(), plan_.source_can_wait),
      frames_(queue_->consumer()) {}

Recorder::~Recorder() { drop_if_nothing_was_received(); }

Status Recorder::open_part() {
  if (plan_.file.empty()) make_room();
  Result<CaptureWriter> created = create_file();
  if (!created) return created.error();
  writer_.emplace(std::move(created).value());
  path_ = writer_->path();
  return {};
}

Result<CaptureWriter> Recorder::create_file() {
  ++part_;
  if (!plan_.file.empty()) return CaptureWriter::create(plan_.file, plan_.vehicle);
  std::error_code error;
  std::filesystem::create_directories(plan_.directory, error);
  if (error)
    return Error{ErrorCode::kInvalidInput, plan_.directory.string() + ": cannot be made: " + error.message() +
                                               "; name another directory in record.directory"};
  // Two recorders that began in the same second take turns.
  const auto is_taken = [this](const std::filesystem::path& path) {
    std::error_code ignored;
    return part_ < kMaxParts && std::filesystem::exists(path, ignored);
  };
  std::filesystem::path path = plan_.directory / recording_name(plan_.began, part_);
  while (is_taken(path)) path = plan_.directory / recording_name(plan_.began, ++part_);
  return CaptureWriter::create(path.string(), plan_.vehicle);
}

void Recorder::make_room() {
  const std::uint64_t keep = plan_.max_total_bytes - std::min(plan_.max_total_bytes, plan_.max_file_bytes);
  for (const std::filesystem::path& removed : remove_oldest_recordings(plan_.directory, keep))
    voice_.note("removed the oldest recording, " + removed.string() + ": all together reached " +
                size_text(plan_.max_total_bytes) + " (record.max_total_mb)");
}

StepResult Recorder::step() {
  const bool closed = frames_.closed();
  LinkFrame frame;
  std::size_t taken = 0;
  while (taken < kFramesPerStep && frames_.try_pop(frame)) {
    record(frame);
    ++taken;
  }
  tell_refused();
  if (writer_ && taken > 0) {
    if (const Status flushed = writer_->flush(); !flushed) stop(flushed.error());
  }
  if (writer_) bytes_.store(closed_bytes_ + writer_->size(), std::memory_order_relaxed);
  if (taken > 0) return StepResult::kProgress;
  if (!closed) return StepResult::kIdle;
  finish();
  return StepResult::kFinished;
}

void Recorder::record(const LinkFrame& frame) {
  if (!writer_) return;
  Status written;
  if (must_change_file_before(frame)) written = change_file(frame.at);
  if (written) written = writer_->write(frame);
  if (!written) return stop(written.error());
  note_exchange(frame);
  ++packets_;
}

void Recorder::note_exchange(const LinkFrame& frame) {
  const bool from_vehicle = frame.direction == LinkDirection::kFromVehicle;
  vehicle_received_ = vehicle_received_ || from_vehicle;
  if (is_on(frame.packet(), kLogControlTopic)) awaits_reply_ = !from_vehicle;
  if (plan_.file.empty()) static_cast<void>(session_.on_frame(frame));
}

bool Recorder::must_change_file_before(const LinkFrame& frame) const {
  return plan_.file.empty() && writer_->size() >= plan_.max_file_bytes && !awaits_reply_ &&
         frame.direction == LinkDirection::kFromVehicle && is_on(frame.packet(), kLogDataTopic);
}

Status Recorder::change_file(HostTime at) {
  if (Status closed = writer_->close(); !closed) return closed;
  closed_bytes_ += writer_->size();
  if (Status opened = open_part(); !opened) return opened;
  for (const LinkFrame& frame : session_preamble(session_, at))
    if (Status written = writer_->write(frame); !written) return written;
  voice_.note("the recording goes on in " + path_);
  return {};
}

void Recorder::tell_refused() {
  if (refusal_told_ || queue_->rejected_count() == 0) return;
  refusal_told_ = true;
  voice_.problem("the recording has a hole: the disk of " + path_ +
                 " was too slow and packets were left out; replayed, it will lack samples");
}

void Recorder::stop(const Error& error) {
  writer_.reset();
  failed_.store(true, std::memory_order_relaxed);
  voice_.problem("recording stopped: " + error.message + "; " + path_ +
                 " holds what came before; make room or record elsewhere");
}

void Recorder::finish() {
  if (!writer_) return;
  if (const Status closed = writer_->close(); !closed) return stop(closed.error());
  if (!vehicle_received_) {
    drop_if_nothing_was_received();
    return voice_.note("the vehicle was never received; no recording is kept");
  }
  writer_.reset();
  const std::uint64_t refused = queue_->rejected_count();
  voice_.note("recorded " + std::to_string(packets_) + " packets, " + size_text(bytes()) +
              (refused > 0 ? ", " + std::to_string(refused) + " left out" : std::string()) + ": " + path_);
}

void Recorder::drop_if_nothing_was_received() {
  if (!writer_ || vehicle_received_) return;
  writer_.reset();
  std::error_code ignored;
  std::filesystem::remove(path_, ignored);
}

RecorderThread::RecorderThread(Recorder& recorder)
    : recorder_(recorder), thread_([&recorder] {
        pthread_setname_np(pthread_self(), "recorder");
        for (StepResult result{}; result != StepResult::kFinished;) {
          result = recorder.step();
          if (result == StepResult::kIdle) std::this_thread::sleep_for(kTick);
        }
      }) {}

RecorderThread::~RecorderThread() {
  recorder_.sink().close();
  thread_.join();
}

}  // namespace swiftlet
