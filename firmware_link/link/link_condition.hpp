// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <string_view>

#include "firmware_link/link/link_statistics.hpp"
#include "firmware_link/link/usb_device.hpp"

namespace swiftlet {

/// One line for the user: what the link waits for and what to do.
[[nodiscard]] std::string_view describe(LinkCondition condition);

/// The condition of a link whose device failed that way. Precondition: not kDone.
[[nodiscard]] LinkCondition condition_of(UsbOutcome failure);

}  // namespace swiftlet
