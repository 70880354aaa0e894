// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include "firmware_link/capture/capture_format.hpp"
#include "firmware_link/input/input_uri.hpp"

namespace swiftlet {

/// Whom a recording of this input belongs to. The layout knows radio and USB only: what comes another way
/// counts as USB, and its serial number is what it is called, in ASCII ("udp:19850", "usb:0", "sim:office"),
/// cut off at 12 characters or filled up with zeros. Precondition: not a file.
[[nodiscard]] CaptureVehicle capture_vehicle_of(const InputUri& input);

}  // namespace swiftlet
