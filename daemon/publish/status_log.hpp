// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <string>

#include "daemon/publish/publisher.hpp"
#include "daemon/workers/pipeline_messages.hpp"

namespace swiftlet {

// The publisher's thread writes the log for the workers that must not: it has their counters.

/// One line for whatever deserves attention between two statuses: refusals, roll-backs, a new beginning of
/// the dead reckoning, solver failures. Allocates.
void log_changes(const DaemonStatus& before, const DaemonStatus& now);
/// Where the run stands, in half a line. Allocates.
[[nodiscard]] std::string status_text(const DaemonStatus& status);
/// One line for what happened to the vehicle or its link. Allocates.
void log_event(const VehicleEvent& event);
/// One line for a loop closure found or dropped. Allocates.
void log_closure(const ClosureUpdate& update);

}  // namespace swiftlet
