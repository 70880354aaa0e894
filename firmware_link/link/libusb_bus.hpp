// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <memory>

#include "core/base/result.hpp"
#include "firmware_link/link/usb_device.hpp"

struct libusb_context;

namespace swiftlet {

/// The machine's USB, by libusb. Claims the interface it is asked for and nothing else; detaches no driver.
/// Must outlive the devices it opened. One thread at a time, devices included.
class LibusbBus final : public UsbBus {
 public:
  /// Error: kNotFound: this system has no USB that libusb can use.
  [[nodiscard]] static Result<std::unique_ptr<UsbBus>> open();
  ~LibusbBus() override;

  [[nodiscard]] std::vector<UsbIdentity> list(std::uint16_t vendor, std::uint16_t product) override;
  [[nodiscard]] std::variant<std::unique_ptr<UsbDevice>, UsbOutcome> open(const UsbIdentity& identity,
                                                                          int interface) override;
  [[nodiscard]] bool has_changed() override;

 private:
  explicit LibusbBus(libusb_context* context);

  libusb_context* context_;
  bool reports_changes_ = false;
  bool has_changed_ = false;  ///< set by libusb's callback, within calls of this thread
};

}  // namespace swiftlet
