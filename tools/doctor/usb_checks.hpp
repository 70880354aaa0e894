// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "firmware_link/link/radio_address.hpp"
#include "firmware_link/link/usb_device.hpp"
#include "tools/doctor/finding.hpp"
#include "tools/doctor/system_files.hpp"

namespace swiftlet {

/// What is plugged in of the devices that swiftlet knows.
struct PluggedIn {
  std::vector<UsbIdentity> dongles;       ///< Crazyradio PA and 2.0
  std::vector<UsbIdentity> boot_loaders;  ///< Crazyradio PA waiting for firmware
  std::vector<UsbIdentity> vehicles;      ///< Crazyflies on their own cable
};
[[nodiscard]] PluggedIn look_at_bus(UsbBus& bus);

/// The one that the URI names by index or serial number, or any of them for "*".
[[nodiscard]] std::optional<UsbIdentity> named_dongle(const PluggedIn& plugged_in, const RadioAddress& radio);
/// The `index`-th vehicle on a cable.
[[nodiscard]] std::optional<UsbIdentity> named_vehicle(const PluggedIn& plugged_in, int index);

/// "dongle"
[[nodiscard]] Finding check_dongle(const PluggedIn& plugged_in, const RadioAddress& radio,
                                   const SystemFiles& files);
/// "dongle firmware"
[[nodiscard]] Finding check_dongle_firmware(const UsbIdentity& dongle);
/// "cable": the vehicle as a USB device.
[[nodiscard]] Finding check_cable(const PluggedIn& plugged_in, int index, const SystemFiles& files);
/// "permission"
[[nodiscard]] Finding check_permission(const UsbIdentity& device, const SystemFiles& files);
/// "in use": tries to open the device, and finds out who has it.
[[nodiscard]] Finding check_in_use(UsbBus& bus, const UsbIdentity& device, const SystemFiles& files);
/// "usb power": whether the kernel puts the device to sleep while nobody has it open.
[[nodiscard]] Finding check_usb_power(const UsbIdentity& device, const SystemFiles& files);

}  // namespace swiftlet
