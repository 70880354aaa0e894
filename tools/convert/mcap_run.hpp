// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <cstdint>

#include "core/base/result.hpp"
#include "daemon/outputs/mcap_writer.hpp"
#include "daemon/view/foxglove_feed.hpp"
#include "daemon/workers/pruned_scans.hpp"

namespace swiftlet {

/// A run as an MCAP file of Foxglove's messages (docs/foxglove.md). One thread at a time.
class McapRun {
 public:
  /// Begins the file.
  explicit McapRun(FileSink write);

  /// What is new in the history.
  void add_news(const RunHistory& history);
  /// The rest of it, now that the run has ended.
  void add_last(const RunHistory& history);
  /// The path as corrected at the end, all its samples. Errors: as for_each_scan().
  [[nodiscard]] Status add_trajectory(const Backend& backend, const PrunedScans* pruned);
  /// Ends the file. Call once, last.
  void finish() { writer_.finish(); }

  [[nodiscard]] std::uint64_t messages() const { return writer_.messages(); }

 private:
  McapWriter writer_;
  FoxgloveFeed feed_;
};

}  // namespace swiftlet
