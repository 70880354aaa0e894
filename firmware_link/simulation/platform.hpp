// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "firmware_link/simulation/packet.hpp"

namespace swiftlet {

// Services of the vehicle's firmware without state. Each returns the answer to a packet of its port; nullopt:
// the firmware does not answer.

/// Port 15: echo, source, sink; null packets get no answer (a radio acknowledges them).
[[nodiscard]] std::optional<PacketBytes> answer_link_service(std::span<const std::uint8_t> packet);

/// Port 13: protocol version 12, firmware, type of vehicle. Platform commands are answered and change
/// nothing; packets of the app channel are not answered.
[[nodiscard]] std::optional<PacketBytes> answer_platform_service(std::span<const std::uint8_t> packet);

/// supervisor.info of a vehicle that arms itself and can fly. Bits: 0 can be armed, 1 armed, 2 arms itself,
/// 3 can fly, 4 flies.
[[nodiscard]] std::uint16_t supervisor_info(bool is_flying);

/// Port 9: single states and all of them as bits; arming and recovery succeed and change nothing, disarming
/// fails, the emergency stop is ignored.
[[nodiscard]] std::optional<PacketBytes> answer_supervisor_service(std::span<const std::uint8_t> packet,
                                                                   bool is_flying);

}  // namespace swiftlet
