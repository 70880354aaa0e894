// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <variant>
#include <vector>

#include "firmware_link/link/radio_address.hpp"
#include "firmware_link/link/usb_device.hpp"

namespace swiftlet {

/// Sends one poll at each data rate and channel that the dongle has and returns the addresses that
/// acknowledged: `wanted` with the rates and channels found; or why the dongle cannot be used. Takes one to
/// two seconds with a real dongle. Not while a RadioLink uses the same dongle.
[[nodiscard]] std::variant<std::vector<RadioAddress>, UsbOutcome> scan_radio(UsbBus& bus,
                                                                             const RadioAddress& wanted);

}  // namespace swiftlet
