// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <memory>

#include "core/base/result.hpp"
#include "firmware_link/input/input_uri.hpp"
#include "firmware_link/link/link.hpp"
#include "firmware_link/link/link_clock.hpp"
#include "firmware_link/link/usb_device.hpp"

namespace swiftlet {

/// A link to a real (or faraway simulated) vehicle, and what has to live as long as it.
struct LiveLink {
  std::shared_ptr<LinkClock> clock;
  std::shared_ptr<UsbBus> usb_bus;  ///< nullptr without USB
  std::unique_ptr<Link> link;
};

/// For radio://, usb:// and udp://. Devices need not be there yet: the link waits for them. Errors:
/// kNotFound: a host name that does not resolve. kInvalidInput: the machine offers no USB or no sockets.
[[nodiscard]] Result<LiveLink> open_live_link(const InputUri& uri);

}  // namespace swiftlet
