// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <stop_token>

#include "core/base/result.hpp"
#include "core/evaluation/consistency.hpp"
#include "daemon/outputs/run_outputs.hpp"
#include "tools/map_command.hpp"
#include "tools/prepared_run.hpp"

namespace swiftlet {

/// How a run is watched and stopped while it goes on.
struct MappingWatch {
  std::function<void(std::optional<double> progress)> after_sample{};  ///< the share of the input, 0 to 1
  std::stop_token stop{};         ///< ends it before its time: looked at before each sample
  bool keeps_confidence = false;  ///< for poses_with_doubt()
};

/// An input that was taken through the pipeline to its end, with the final pass: what `swiftlet map`,
/// `swiftlet convert` and Python's swiftlet.map() have in common. One thread at a time.
class MappedRun {
 public:
  /// Maps `prepared`, made of the same command, in this thread. What is pruned on the way lies in `scratch`,
  /// in a file without a name. Errors: kInvalidInput: the input holds no usable sample, or `scratch` cannot
  /// be written; kTimeout: stopped. Damage after usable samples is no error: damage_of(report()).
  [[nodiscard]] static Result<std::unique_ptr<MappedRun>> make(const MapCommand& command,
                                                               PreparedRun prepared,
                                                               const std::filesystem::path& scratch,
                                                               const MappingWatch& watch);
  ~MappedRun();
  MappedRun(const MappedRun&) = delete;
  MappedRun& operator=(const MappedRun&) = delete;

  /// For its outputs. References into this.
  [[nodiscard]] RunView view() const;
  [[nodiscard]] const Backend& backend() const;
  [[nodiscard]] const InputReport& report() const;
  /// As published on the way, one a sample, but for those of the final pass; empty unless asked for.
  [[nodiscard]] std::span<const DoubtedPose> poses_with_doubt() const;

 private:
  struct State;
  explicit MappedRun(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

/// The same, with progress on stderr where that is a terminal.
[[nodiscard]] Result<std::unique_ptr<MappedRun>> map_with_progress_bar(const MapCommand& command,
                                                                       PreparedRun prepared,
                                                                       const std::filesystem::path& scratch,
                                                                       const std::stop_token& stop = {});

}  // namespace swiftlet
