// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <cstdint>
#include <string>

#include "core/base/result.hpp"
#include "firmware_link/radio_address.hpp"

namespace swiftlet {

/// What an input's URI names.
struct InputUri {
  enum class Kind { kFile, kSimulation, kRadio, kUsbCable, kUdp };
  Kind kind = Kind::kFile;
  std::string path;        ///< kFile
  std::string world;       ///< kSimulation
  std::uint64_t seed = 1;  ///< kSimulation
  RadioAddress radio;      ///< kRadio
  int usb_index = 0;       ///< kUsbCable: which of the vehicles on cables, from 0
  std::string host;        ///< kUdp: name or address
  std::uint16_t port = 0;  ///< kUdp
};

/// `radio://DONGLE/CHANNEL/RATE/ADDRESS[?safelink=0&rate_limit=N]`, `usb://N`, `udp://HOST:PORT`,
/// `sim://WORLD?seed=N`, `replay:FILE` or a plain path. Errors: kInvalidInput, with a line for the user.
[[nodiscard]] Result<InputUri> parse_input_uri(const std::string& uri);

}  // namespace swiftlet
