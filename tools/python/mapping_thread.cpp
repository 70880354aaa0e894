// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "tools/python/mapping_thread.hpp"

#include <filesystem>
#include <memory>
#include <system_error>
#include <utility>

#include "daemon/outputs/output_directory.hpp"
#include "daemon/outputs/run_outputs.hpp"
#include "daemon/outputs/run_report.hpp"
#include "tools/mapped_run.hpp"
#include "tools/prepared_run.hpp"

namespace swiftlet {
namespace {

/// Where scans that are pruned on the way lie when nothing is written.
std::filesystem::path scratch_directory() {
  std::error_code failure;
  const std::filesystem::path directory = std::filesystem::temp_directory_path(failure);
  return failure ? "/tmp" : directory;
}

Result<MappedInput> mapped_input(const MappedRun& run) {
  Result<RunArrays> arrays = arrays_of(run);
  if (!arrays) return arrays.error();
  return MappedInput{.arrays = std::move(arrays).value(),
                     .report_json = run_report_json(run.view()),
                     .notes = run.report().notes,
                     .problems = run.report().problems};
}

}  // namespace

Result<MappedInput> map_whole_input(const MapCommand& command, const std::stop_token& stop,
                                    std::atomic<double>& progress) {
  std::optional<OutputDirectory> output;
  if (command.output_directory) {
    Result<OutputDirectory> opened = OutputDirectory::open(*command.output_directory);
    if (!opened) return opened.error();
    output.emplace(std::move(opened).value());
  }
  Result<PreparedRun> prepared = prepare_run(command, stop);
  if (!prepared) return prepared.error();
  const MappingWatch watch{
      .after_sample = [&](std::optional<double> done) { progress = done.value_or(-1.0); },
      .stop = stop,
      .keeps_confidence = true};
  const Result<std::unique_ptr<MappedRun>> run = MappedRun::make(
      command, std::move(prepared).value(), output ? output->path() : scratch_directory(), watch);
  if (!run) return run.error();
  if (output) {
    const Result<WrittenOutputs> written = write_run_outputs(output->path(), (*run)->view());
    if (!written) return written.error();
  }
  return mapped_input(**run);
}

MappingThread::MappingThread(MapCommand command)
    : thread_([this, command = std::move(command)] { run(command); }) {}

void MappingThread::run(const MapCommand& command) {
  try {
    result_.emplace(map_whole_input(command, stop_.get_token(), progress_));
  } catch (...) {
    thrown_ = std::current_exception();
  }
  const std::lock_guard lock(mutex_);
  has_ended_ = true;
  ended_.notify_all();
}

bool MappingThread::wait(std::chrono::milliseconds at_most) {
  std::unique_lock lock(mutex_);
  return ended_.wait_for(lock, at_most, [this] { return has_ended_; });
}

std::optional<double> MappingThread::progress() const {
  const double progress = progress_;
  if (progress < 0.0) return std::nullopt;
  return progress;
}

void MappingThread::stop() {
  stop_.request_stop();
  if (thread_.joinable()) thread_.join();
}

Result<MappedInput> MappingThread::take_result() {
  if (thread_.joinable()) thread_.join();
  if (thrown_) std::rethrow_exception(thrown_);
  return std::move(*result_);
}

}  // namespace swiftlet
