// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <functional>
#include <stop_token>

#include "core/base/result.hpp"
#include "daemon/view/viewer.hpp"
#include "daemon/workers/pruned_scans.hpp"
#include "tools/prepared_run.hpp"

namespace swiftlet {

/// Called while a recording is mapped, in the same thread. What is not set is not called.
struct RecordingWatch {
  std::function<void()> after_sample;            ///< `shared` is up to date, and its mutex is free
  std::function<Status(const Backend&)> at_end;  ///< after the final pass, when `shared` has it all
  PrunedScans* pruned = nullptr;                 ///< keeps what at_end needs of scans that are pruned
};

/// Maps the input as fast as it can, in this thread, and fills `shared` with what a daemon would have
/// published, each with its moment of the data. Until the end of the input, or until `stop` is requested.
/// Errors: whatever ended the input before its time (`shared` has what came before); those of `watch.at_end`.
[[nodiscard]] Status map_recording(PreparedRun& run, SharedRunHistory& shared, const std::stop_token& stop,
                                   const RecordingWatch& watch);

}  // namespace swiftlet
