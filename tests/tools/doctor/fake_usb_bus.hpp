// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <memory>
#include <utility>
#include <vector>

#include "firmware_link/link/usb_device.hpp"

namespace swiftlet {

/// A bus with the devices that the test plugs in, all of which open with the result `opening`.
class FakeUsbBus final : public UsbBus {
 public:
  std::vector<UsbIdentity> devices;
  UsbOutcome opening = UsbOutcome::kDone;

  std::vector<UsbIdentity> list(std::uint16_t vendor, std::uint16_t product) override {
    std::vector<UsbIdentity> found;
    for (const UsbIdentity& device : devices)
      if (device.vendor == vendor && device.product == product) found.push_back(device);
    return found;
  }
  std::variant<std::unique_ptr<UsbDevice>, UsbOutcome> open(const UsbIdentity& /*identity*/,
                                                            int /*interface*/) override {
    if (opening != UsbOutcome::kDone) return opening;
    return std::unique_ptr<UsbDevice>(std::make_unique<SilentDevice>());
  }
  bool has_changed() override { return true; }

 private:
  class SilentDevice final : public UsbDevice {
   public:
    UsbTransfer control_out(std::uint8_t, std::uint16_t, std::uint16_t, std::span<const std::uint8_t>,
                            Duration) override {
      return {UsbOutcome::kTimeout, 0};
    }
    UsbTransfer bulk_out(std::uint8_t, std::span<const std::uint8_t>, Duration) override {
      return {UsbOutcome::kTimeout, 0};
    }
    UsbTransfer bulk_in(std::uint8_t, std::span<std::uint8_t>, Duration) override {
      return {UsbOutcome::kTimeout, 0};
    }
    UsbOutcome clear_halt(std::uint8_t) override { return UsbOutcome::kDone; }
    UsbOutcome reset() override { return UsbOutcome::kDone; }
  };
};

inline UsbIdentity plugged_in_at(std::uint8_t bus, std::uint8_t address, std::uint16_t vendor,
                                 std::uint16_t product) {
  UsbIdentity device;
  device.bus = bus;
  device.address = address;
  device.vendor = vendor;
  device.product = product;
  return device;
}

inline UsbIdentity crazyradio_pa() {
  UsbIdentity dongle = plugged_in_at(1, 4, 0x1915, 0x7777);
  dongle.release_bcd = 0x0053;
  dongle.manufacturer = "Bitcraze";
  dongle.name = "Crazyradio PA USB Dongle";
  dongle.serial = "0123456789";
  return dongle;
}

}  // namespace swiftlet
