// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <optional>
#include <type_traits>

#include "core/base/time.hpp"
#include "firmware_link/link/link_statistics.hpp"
#include "firmware_link/link/sharing_status.hpp"

namespace swiftlet {

/// The vehicle's state by its latest log data; nullopt: not logged.
struct VehicleHealth {
  std::optional<int> battery_mv;
  std::optional<int> rssi_dbm;  ///< of our packets at the vehicle
  std::optional<bool> is_flying;
  bool battery_is_low = false;
};

/// The state of a live input.
struct LiveStatus {
  LinkStatistics link;
  Duration round_trip{0};  ///< to the vehicle and back, the last one measured; 0 before the first
  VehicleHealth vehicle;
  SharingStatus sharing;
};
static_assert(std::is_trivially_copyable_v<LiveStatus>);

}  // namespace swiftlet
