// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <string>

#include "core/base/time.hpp"

namespace swiftlet {

/// A moment in UTC, to the second below, in a form of strftime(3) that makes less than 32 characters.
[[nodiscard]] [[gnu::format(strftime, 2, 0)]] std::string utc_text(HostTime at, const char* form);

}  // namespace swiftlet
