// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
// Any text as an input's URI.
#include <cstddef>
#include <cstdint>
#include <string>

#include "core/base/check.hpp"
#include "firmware_link/input/input_uri.hpp"

// NOLINTNEXTLINE(readability-identifier-naming): libFuzzer calls it by this name
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using swiftlet::InputUri;
  const std::string uri(reinterpret_cast<const char*>(data), size);
  const swiftlet::Result<InputUri> parsed = swiftlet::parse_input_uri(uri);
  if (!parsed) {
    SWIFTLET_CHECK(parsed.error().code == swiftlet::ErrorCode::kInvalidInput, "a bad URI is bad input");
    SWIFTLET_CHECK(parsed.error().message.starts_with("input '" + uri + "': "), "the message names the URI");
    return 0;
  }
  switch (parsed->kind) {
    case InputUri::Kind::kFile:
      SWIFTLET_CHECK(!parsed->path.empty(), "a file has a name");
      break;
    case InputUri::Kind::kSimulation:
      SWIFTLET_CHECK(!parsed->world.empty(), "a world has a name");
      break;
    case InputUri::Kind::kRadio:
      SWIFTLET_CHECK(!parsed->radio.dongle.empty() && parsed->radio.channel <= 125,
                     "a radio can be set to it");
      SWIFTLET_CHECK(parsed->radio.rate_limit_hz.value_or(1) > 0, "a rate limit lets something through");
      break;
    case InputUri::Kind::kUsbCable:
      SWIFTLET_CHECK(parsed->usb_index >= 0, "vehicles are counted from 0");
      break;
    case InputUri::Kind::kUdp:
      SWIFTLET_CHECK(!parsed->host.empty() && parsed->port > 0, "a host can be looked up");
      break;
  }
  return 0;
}
