// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "firmware_link/link/radio_scan.hpp"

#include <array>

#include "firmware_link/link/crazyradio.hpp"

namespace swiftlet {
namespace {

constexpr std::array kRates{RadioRate::k250Kbps, RadioRate::k1Mbps, RadioRate::k2Mbps};
constexpr std::uint8_t kRetries = 1;

}  // namespace

std::variant<std::vector<RadioAddress>, UsbOutcome> scan_radio(UsbBus& bus, const RadioAddress& wanted) {
  RadioAddress address = wanted;
  // What every dongle has.
  address.rate = RadioRate::k2Mbps;
  address.channel = 0;
  std::variant<Crazyradio, UsbOutcome> opened = Crazyradio::open(bus, address);
  if (const UsbOutcome* failure = std::get_if<UsbOutcome>(&opened)) return *failure;
  Crazyradio& radio = std::get<Crazyradio>(opened);
  if (const UsbOutcome outcome = radio.set_retries(kRetries); outcome != UsbOutcome::kDone) return outcome;
  std::vector<RadioAddress> found;
  for (const RadioRate rate : kRates) {
    if (rate < radio.range().slowest) continue;
    address.rate = rate;
    if (const UsbOutcome outcome = radio.set_rate(rate); outcome != UsbOutcome::kDone) return outcome;
    for (address.channel = 0; address.channel <= radio.range().last_channel; ++address.channel) {
      if (const UsbOutcome outcome = radio.set_channel(address.channel); outcome != UsbOutcome::kDone)
        return outcome;
      const RadioAnswer answer = radio.exchange(kRadioPollPacket);
      if (!answer.may_go_on()) return answer.outcome;
      if (answer.acknowledged) found.push_back(address);
    }
  }
  return found;
}

}  // namespace swiftlet
