// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "core/base/result.hpp"

namespace swiftlet {

inline constexpr std::string_view kUdpScheme = "udp://";

/// Where the vendor's simulated vehicles listen, and swiftlet's: the port, and with it on this machine, as a
/// URI and without its scheme.
inline constexpr std::uint16_t kDefaultUdpPort = 19850;
inline constexpr const char* kLocalUdpUri = "udp://127.0.0.1:19850";
inline constexpr const char* kLocalUdpAddress = kLocalUdpUri + kUdpScheme.size();

/// Where a vehicle listens: what a udp:// URI names.
struct UdpAddress {
  std::string host;  ///< name or address
  std::uint16_t port = kDefaultUdpPort;
};

/// `HOST[:PORT]`, an IPv6 address in brackets. Error: kInvalidInput: what is wrong.
[[nodiscard]] Result<UdpAddress> parse_udp_address(std::string_view text);

}  // namespace swiftlet
