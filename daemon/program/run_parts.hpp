// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <memory>

#include "core/base/result.hpp"
#include "daemon/commands/command_listener.hpp"
#include "daemon/config/configuration.hpp"
#include "daemon/outputs/output_directory.hpp"
#include "daemon/program/options.hpp"
#include "daemon/publish/lcm_transport.hpp"
#include "daemon/publish/publisher.hpp"
#include "daemon/recording/recorder.hpp"
#include "daemon/view/live_view.hpp"
#include "daemon/workers/pruned_scans.hpp"
#include "firmware_link/sample/sample_source.hpp"

namespace swiftlet {

/// Where a run writes to.
struct Outputs {
  OutputDirectory directory;
  PrunedScans pruned;
};

/// What a run reads, writes and serves, in the order in which it is opened; what is not asked for is nullptr.
struct RunParts {
  std::unique_ptr<Recorder> recorder;
  std::unique_ptr<SampleSource> source;
  std::unique_ptr<Outputs> outputs;
  std::unique_ptr<LiveView> view;
  std::unique_ptr<LcmTransport> lcm;
  std::unique_ptr<Publisher> publisher;
  std::unique_ptr<CommandListener> commands;

  /// Errors: what cannot be opened, in a line for the user; then all is closed again.
  [[nodiscard]] static Result<std::unique_ptr<RunParts>> open(const Options& options,
                                                              const Configuration& config);
};

}  // namespace swiftlet
