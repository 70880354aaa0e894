// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
// Any text as an input's URI.
#include <cstddef>
#include <cstdint>
#include <string>

#include "core/base/check.hpp"
#include "firmware_link/input/input_uri.hpp"
#include "firmware_link/link/radio_address.hpp"
#include "firmware_link/link/udp_address.hpp"
#include "firmware_link/simulation/address.hpp"

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
  SWIFTLET_CHECK(parsed->kind != nullptr && parsed->address.has_value(), "a good URI names something");
  if (const auto* file = parsed->as<swiftlet::InputFile>())
    SWIFTLET_CHECK(!file->path.empty(), "a file has a name");
  if (const auto* flight = parsed->as<swiftlet::SimulationAddress>())
    SWIFTLET_CHECK(!flight->world.empty(), "a world has a name");
  if (const auto* radio = parsed->as<swiftlet::RadioAddress>()) {
    SWIFTLET_CHECK(!radio->dongle.empty() && radio->channel <= 125, "a radio can be set to it");
    SWIFTLET_CHECK(radio->rate_limit_hz.value_or(1) > 0, "a rate limit lets something through");
  }
  if (const auto* cable = parsed->as<swiftlet::UsbCableAddress>())
    SWIFTLET_CHECK(cable->index >= 0, "vehicles are counted from 0");
  if (const auto* udp = parsed->as<swiftlet::UdpAddress>())
    SWIFTLET_CHECK(!udp->host.empty() && udp->port > 0, "a host can be looked up");
  return 0;
}
