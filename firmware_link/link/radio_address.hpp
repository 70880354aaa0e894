// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "core/base/result.hpp"

namespace swiftlet {

/// Numbered as in the dongle's data rate request.
enum class RadioRate : std::uint8_t { k250Kbps = 0, k1Mbps = 1, k2Mbps = 2 };

/// Which vehicle, through which dongle: what a radio:// URI names. The defaults are the vehicle's factory
/// setting.
struct RadioAddress {
  std::string dongle = "0";   ///< index (fewer than 10 digits) or serial number, in capitals; "*": any
  std::uint8_t channel = 80;  ///< 0..125: 2400 + channel MHz
  RadioRate rate = RadioRate::k2Mbps;
  std::array<std::uint8_t, 5> address{0xE7, 0xE7, 0xE7, 0xE7, 0xE7};  ///< in the order of the URI's text
  bool safelink = true;
  std::optional<int> rate_limit_hz;  ///< packets a second at most
};

/// `DONGLE/CHANNEL/RATE/ADDRESS[?safelink=0|1&rate_limit=N]` (DONGLE: index, serial number or *; RATE: 250K,
/// 1M or 2M; parts missing at the end are RadioAddress's; the address is filled up with zeros from the left).
/// Error: kInvalidInput: what is wrong.
[[nodiscard]] Result<RadioAddress> parse_radio_address(std::string_view text);

}  // namespace swiftlet
