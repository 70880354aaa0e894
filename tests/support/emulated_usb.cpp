// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "tests/support/emulated_usb.hpp"

#include <algorithm>
#include <utility>

namespace swiftlet {
namespace {

constexpr std::uint8_t kBus = 1;
constexpr Duration kControlRequest = std::chrono::milliseconds(1);
constexpr Duration kOpening = std::chrono::milliseconds(2);
constexpr Duration kReset = std::chrono::milliseconds(100);
constexpr Duration kUsbFrame = std::chrono::milliseconds(1);

/// The dongle as it was when it was opened: plugged in anew it is another device.
class EmulatedUsbDevice final : public UsbDevice {
 public:
  EmulatedUsbDevice(EmulatedCrazyradio& dongle, ScheduledLinkClock& clock)
      : dongle_(dongle), clock_(clock), address_(dongle.bus_address()) {}

  UsbTransfer control_out(std::uint8_t request, std::uint16_t value, std::uint16_t index,
                          std::span<const std::uint8_t> data, Duration /*timeout*/) override {
    clock_.advance(kControlRequest);
    if (is_gone()) return {UsbOutcome::kNoDevice, 0};
    return {dongle_.control_out({request, value, index, {data.begin(), data.end()}}), data.size()};
  }

  UsbTransfer bulk_out(std::uint8_t /*endpoint*/, std::span<const std::uint8_t> bytes,
                       Duration timeout) override {
    const UsbOutcome outcome = is_gone() ? UsbOutcome::kNoDevice : dongle_.bulk_out(bytes);
    if (outcome == UsbOutcome::kTimeout) clock_.advance(timeout);
    return {outcome, outcome == UsbOutcome::kDone ? bytes.size() : 0};
  }

  UsbTransfer bulk_in(std::uint8_t /*endpoint*/, std::span<std::uint8_t> buffer, Duration timeout) override {
    const HostTime give_up_at = clock_.now() + timeout;
    for (;;) {
      if (is_gone()) return {UsbOutcome::kNoDevice, 0};
      const UsbTransfer transfer = dongle_.bulk_in(buffer);
      const Duration left = give_up_at - clock_.now();
      if (transfer.outcome != UsbOutcome::kTimeout || left <= Duration::zero()) return transfer;
      // In steps, for the dongle may be pulled meanwhile.
      clock_.advance(std::min(left, std::clamp(dongle_.answer_in().value_or(kUsbFrame),
                                               Duration(std::chrono::microseconds(1)), kUsbFrame)));
    }
  }

  UsbOutcome clear_halt(std::uint8_t endpoint) override {
    clock_.advance(kControlRequest);
    return is_gone() ? UsbOutcome::kNoDevice : dongle_.clear_halt(endpoint);
  }

  UsbOutcome reset() override {
    clock_.advance(kReset);
    return is_gone() ? UsbOutcome::kNoDevice : dongle_.reset();
  }

 private:
  [[nodiscard]] bool is_gone() const { return !dongle_.is_plugged_in() || dongle_.bus_address() != address_; }

  EmulatedCrazyradio& dongle_;
  ScheduledLinkClock& clock_;
  std::uint8_t address_;
};

}  // namespace

std::vector<UsbIdentity> EmulatedUsbBus::list(std::uint16_t vendor, std::uint16_t product) {
  if (!dongle_.is_plugged_in() || vendor != EmulatedCrazyradio::kVendor ||
      product != EmulatedCrazyradio::kProduct)
    return {};
  UsbIdentity identity;
  identity.vendor = vendor;
  identity.product = product;
  identity.release_bcd = dongle_.release_bcd();
  identity.bus = kBus;
  identity.address = dongle_.bus_address();
  if (dongle_.denies_access) {
    identity.access = UsbOutcome::kAccessDenied;
  } else {
    identity.manufacturer = EmulatedCrazyradio::kManufacturer;
    identity.name = dongle_.name();
    identity.serial = EmulatedCrazyradio::kSerial;
  }
  return {identity};
}

std::variant<std::unique_ptr<UsbDevice>, UsbOutcome> EmulatedUsbBus::open(const UsbIdentity& identity,
                                                                          int /*interface*/) {
  clock_.advance(kOpening);
  if (!dongle_.is_plugged_in() || dongle_.bus_address() != identity.address) return UsbOutcome::kNoDevice;
  if (dongle_.denies_access) return UsbOutcome::kAccessDenied;
  if (dongle_.claimed_by_another) return UsbOutcome::kBusy;
  return std::make_unique<EmulatedUsbDevice>(dongle_, clock_);
}

bool EmulatedUsbBus::has_changed() {
  const int here = dongle_.is_plugged_in() ? dongle_.bus_address() : 0;
  return std::exchange(seen_, here) != here;
}

}  // namespace swiftlet
