// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "core/base/time.hpp"

namespace swiftlet {

/// How a USB transfer or an attempt to open a device ended. libusb's codes, without libusb.
enum class UsbOutcome : std::uint8_t {
  kDone,
  kTimeout,       ///< LIBUSB_ERROR_TIMEOUT
  kStall,         ///< LIBUSB_ERROR_PIPE
  kOverflow,      ///< LIBUSB_ERROR_OVERFLOW: the device sent more than was requested
  kNoDevice,      ///< LIBUSB_ERROR_NO_DEVICE, NOT_FOUND: unplugged, or never there
  kAccessDenied,  ///< LIBUSB_ERROR_ACCESS
  kBusy,          ///< LIBUSB_ERROR_BUSY: another program has claimed the interface
  kFault,         ///< LIBUSB_ERROR_IO and all others
  kUnsuited,      ///< it works, but lacks what was asked for
};

/// How long a device may take for a request, and to accept bytes.
inline constexpr Duration kUsbControlTimeout = std::chrono::seconds(1);
inline constexpr Duration kUsbOutTimeout = std::chrono::milliseconds(100);

struct UsbTransfer {
  UsbOutcome outcome = UsbOutcome::kDone;
  std::size_t size = 0;  ///< bytes transferred, also of a transfer that timed out
  [[nodiscard]] bool done() const { return outcome == UsbOutcome::kDone; }
};

/// An opened device, its interface claimed; closed by the destructor. Calls wait. One thread at a time; no
/// allocation by transfers (beyond libusb's own).
class UsbDevice {
 public:
  UsbDevice() = default;
  virtual ~UsbDevice() = default;
  UsbDevice(const UsbDevice&) = delete;
  UsbDevice& operator=(const UsbDevice&) = delete;

  /// Vendor request to the device (bmRequestType 0x40), without or with data.
  [[nodiscard]] virtual UsbTransfer control_out(std::uint8_t request, std::uint16_t value,
                                                std::uint16_t index, std::span<const std::uint8_t> data,
                                                Duration timeout) = 0;
  [[nodiscard]] virtual UsbTransfer bulk_out(std::uint8_t endpoint, std::span<const std::uint8_t> bytes,
                                             Duration timeout) = 0;
  [[nodiscard]] virtual UsbTransfer bulk_in(std::uint8_t endpoint, std::span<std::uint8_t> buffer,
                                            Duration timeout) = 0;
  [[nodiscard]] virtual UsbOutcome clear_halt(std::uint8_t endpoint) = 0;
  /// kNoDevice: it has become another device: reopen it.
  [[nodiscard]] virtual UsbOutcome reset() = 0;
};

/// A device that is plugged in. Texts are empty where this user may not read them.
struct UsbIdentity {
  std::uint16_t vendor = 0;
  std::uint16_t product = 0;
  std::uint16_t release_bcd = 0;  ///< bcdDevice
  std::uint8_t bus = 0;
  std::uint8_t address = 0;  ///< changes whenever it is plugged in
  std::string manufacturer;
  std::string name;
  std::string serial;
  UsbOutcome access = UsbOutcome::kDone;  ///< kAccessDenied: it is listed but may not be opened
};

/// Finds and opens devices. One thread at a time.
class UsbBus {
 public:
  UsbBus() = default;
  virtual ~UsbBus() = default;
  UsbBus(const UsbBus&) = delete;
  UsbBus& operator=(const UsbBus&) = delete;

  /// All with that vendor and product number, in a fixed order (bus, address). Opens each for its texts.
  [[nodiscard]] virtual std::vector<UsbIdentity> list(std::uint16_t vendor, std::uint16_t product) = 0;
  /// Claims `interface`. The device, or why not: kNoDevice, kAccessDenied, kBusy, kFault.
  [[nodiscard]] virtual std::variant<std::unique_ptr<UsbDevice>, UsbOutcome> open(const UsbIdentity& identity,
                                                                                  int interface) = 0;
  /// Whether a device was plugged in or out since the last call (true if the system does not report it).
  [[nodiscard]] virtual bool has_changed() = 0;
};

}  // namespace swiftlet
