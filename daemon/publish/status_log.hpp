// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "daemon/publish/publisher.hpp"
#include "daemon/workers/pipeline_messages.hpp"

namespace swiftlet {

// The publisher's thread writes the log for the workers that must not: it has their counters.

/// A line about the input.
struct InputNews {
  bool is_warning = true;
  std::string text;
};
/// What deserves attention between two statuses of an input: another condition of the link, holes in the
/// ranges, a new beginning of the dead reckoning, packets of a client that were dropped. Allocates.
[[nodiscard]] std::vector<InputNews> input_news(const InputStatus& before, const InputStatus& now);
/// What a pilot should know when the state of tracking changes; nothing where it has not. Allocates.
[[nodiscard]] std::optional<InputNews> tracking_news(const TrackingFigures& before,
                                                     const TrackingFigures& now);
/// One line for whatever deserves attention between two statuses: input_news(), tracking_news(), refusals,
/// solver failures; in a verbose log roll-backs, too. Allocates.
void log_changes(const DaemonStatus& before, const DaemonStatus& now);
/// Where the run stands, in half a line. Allocates.
[[nodiscard]] std::string status_text(const DaemonStatus& status);
/// One line for what happened to the vehicle or its link. Allocates.
void log_event(const VehicleEvent& event);
/// One line for a loop closure found or dropped. Allocates.
void log_closure(const ClosureUpdate& update);

}  // namespace swiftlet
