// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <optional>
#include <stop_token>
#include <string>
#include <thread>
#include <vector>

#include "core/base/result.hpp"
#include "tools/map_command.hpp"
#include "tools/python/run_arrays.hpp"

namespace swiftlet {

/// All that a caller gets of a run.
struct MappedInput {
  RunArrays arrays;
  std::string report_json;  ///< as report.json
  std::vector<std::string> notes;
  std::vector<std::string> problems;  ///< of an input that was damaged after usable samples
};

/// Maps an input in this thread, and writes its outputs where the command names a directory. Errors: as
/// run_map_command() but for damage, which is among the problems; kTimeout: stopped.
[[nodiscard]] Result<MappedInput> map_whole_input(const MapCommand& command, const std::stop_token& stop,
                                                  std::atomic<double>& progress);

/// The same on a thread of its own, which the caller waits for. One caller.
class MappingThread {
 public:
  explicit MappingThread(MapCommand command);
  /// Stops it.
  ~MappingThread() { stop(); }
  MappingThread(const MappingThread&) = delete;
  MappingThread& operator=(const MappingThread&) = delete;

  /// Waits for its end, so long at most. Whether it has ended.
  [[nodiscard]] bool wait(std::chrono::milliseconds at_most);
  /// The share of the input that was mapped; nullopt where it is not known.
  [[nodiscard]] std::optional<double> progress() const;
  /// Has it end before its time, and waits for that: a calibration or a final pass that has begun is
  /// finished.
  void stop();
  /// Once, after it has ended. Throws what it threw: std::bad_alloc.
  [[nodiscard]] Result<MappedInput> take_result();

 private:
  void run(const MapCommand& command);

  std::mutex mutex_;
  std::condition_variable ended_;
  bool has_ended_ = false;
  std::optional<Result<MappedInput>> result_;
  std::exception_ptr thrown_;
  std::atomic<double> progress_{-1.0};
  std::stop_source stop_;
  std::jthread thread_;  // last: it uses the rest
};

}  // namespace swiftlet
