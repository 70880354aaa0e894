// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <optional>
#include <string>

#include "firmware_link/link/usb_device.hpp"
#include "tools/doctor/system_files.hpp"

namespace swiftlet {

/// A program that has a device open.
struct DeviceHolder {
  int pid = 0;
  std::string command;  ///< with its arguments
};

/// "/dev/bus/usb/001/004"
[[nodiscard]] std::string device_node(const UsbIdentity& device);
/// The first program but this one that has `node` open; nullopt also when it is another user's, into whose
/// /proc/PID/fd this one may not look.
[[nodiscard]] std::optional<DeviceHolder> find_holder(const SystemFiles& files, const std::string& node);

}  // namespace swiftlet
