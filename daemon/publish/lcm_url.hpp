// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <cstdint>
#include <string>

#include "core/base/result.hpp"

namespace swiftlet {

/// The parts of an LCM URL that concern the network, or the disk.
struct LcmUrl {
  enum class Provider : std::uint8_t { kMulticast, kOther };  ///< udpm://, or file://, tcpq://, memq://
  Provider provider = Provider::kMulticast;
  std::string group = "239.255.76.67";
  std::uint16_t port = 7667;
  int ttl = 0;               ///< 0: this machine only, 1: the local network
  std::string file;          ///< of file://: the path of the log; else empty
  bool writes_file = false;  ///< ... which is written, not read
};

/// What LCM leaves out keeps its default. Errors: kInvalidInput, with a line for the user.
[[nodiscard]] Result<LcmUrl> parse_lcm_url(const std::string& url);

}  // namespace swiftlet
