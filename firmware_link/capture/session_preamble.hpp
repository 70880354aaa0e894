// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <vector>

#include "core/base/time.hpp"
#include "firmware_link/link/link.hpp"
#include "firmware_link/session/log_session.hpp"

namespace swiftlet {

/// The exchange from which a reader learns what `session` has learnt so far: the key of the table of
/// contents, the names of the variables in use, and each log block: delete, create, append and start with
/// their replies. A recording that begins with it can be read on its own; in the middle of a recording it
/// changes nothing. All frames have the time `at`. Precondition: no create or append is unanswered.
[[nodiscard]] std::vector<LinkFrame> session_preamble(const LogSession& session, HostTime at);

}  // namespace swiftlet
