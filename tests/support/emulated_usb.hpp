// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <cstdint>
#include <memory>
#include <variant>
#include <vector>

#include "firmware_link/link/usb_device.hpp"
#include "tests/support/emulated_crazyradio.hpp"
#include "tests/support/scheduled_link_clock.hpp"

namespace swiftlet {

/// A bus with an emulated Crazyradio, in simulated time: what takes time moves the clock on. Dongle and clock
/// must outlive it. One thread at a time.
class EmulatedUsbBus final : public UsbBus {
 public:
  EmulatedUsbBus(EmulatedCrazyradio& dongle, ScheduledLinkClock& clock) : dongle_(dongle), clock_(clock) {}

  [[nodiscard]] std::vector<UsbIdentity> list(std::uint16_t vendor, std::uint16_t product) override;
  [[nodiscard]] std::variant<std::unique_ptr<UsbDevice>, UsbOutcome> open(const UsbIdentity& identity,
                                                                          int interface) override;
  [[nodiscard]] bool has_changed() override;

 private:
  EmulatedCrazyradio& dongle_;
  ScheduledLinkClock& clock_;
  int seen_ = 0;  // bus address of the dongle at the last look, 0 when there was none
};

}  // namespace swiftlet
