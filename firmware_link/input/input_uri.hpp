// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <cstdint>
#include <string>

#include "core/base/result.hpp"
#include "firmware_link/link/radio_address.hpp"

namespace swiftlet {

/// Where the vendor's simulated vehicles listen, and swiftlet's.
inline constexpr std::uint16_t kDefaultUdpPort = 19850;

/// What an input's URI names.
struct InputUri {
  enum class Kind { kFile, kSimulation, kRadio, kUsbCable, kUdp };
  Kind kind = Kind::kFile;
  std::string path;                      ///< kFile
  std::string world;                     ///< kSimulation
  std::uint64_t seed = 1;                ///< kSimulation
  int laps = 1;                          ///< kSimulation: how often the world's script is flown
  RadioAddress radio;                    ///< kRadio
  int usb_index = 0;                     ///< kUsbCable: which of the vehicles on cables, from 0
  std::string host;                      ///< kUdp: name or address
  std::uint16_t port = kDefaultUdpPort;  ///< kUdp
};

/// `radio://DONGLE/CHANNEL/RATE/ADDRESS[?safelink=0|1&rate_limit=N]` (DONGLE: index, serial number or *;
/// RATE: 250K, 1M or 2M; parts missing at the end are RadioAddress's; the address is filled up with zeros
/// from the left), `usb://N`, `udp://HOST[:PORT]` (IPv6 in brackets), `sim://WORLD[?seed=N&laps=N]`,
/// `replay:FILE` or a plain path. Errors: kInvalidInput, with a line for the user that shows how to write it.
[[nodiscard]] Result<InputUri> parse_input_uri(const std::string& uri);

}  // namespace swiftlet
