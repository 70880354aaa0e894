// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <cstdint>
#include <type_traits>

namespace swiftlet {

/// Packets of the clients of a shared link that were not sent, since it was opened.
struct SharingCounters {
  std::uint64_t steering_dropped = 0;  ///< no room, or the vehicle was not received
  std::uint64_t requests_dropped = 0;  ///< no room; of all that does not steer
};

/// The state of a link that a client may share.
struct SharingStatus {
  bool is_shared = false;  ///< a client may connect
  bool has_client = false;
  SharingCounters counters;
};
static_assert(std::is_trivially_copyable_v<SharingStatus>);

}  // namespace swiftlet
