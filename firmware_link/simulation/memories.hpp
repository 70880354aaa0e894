// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "firmware_link/simulation/packet.hpp"

namespace swiftlet {

/// The memories of the vehicle's firmware (CRTP port 4): 0 is the EEPROM with the radio's settings (8 KiB,
/// survives a reboot), 1 the tester, whose every byte is the low byte of its address. One thread at a time;
/// allocates.
class SimulatedMemories {
 public:
  SimulatedMemories();

  /// The answer to a packet of port 4; nullopt: the firmware does not answer.
  [[nodiscard]] std::optional<PacketBytes> handle(std::span<const std::uint8_t> packet);

 private:
  [[nodiscard]] static std::optional<PacketBytes> answer_info(std::span<const std::uint8_t> packet);
  [[nodiscard]] std::optional<PacketBytes> read(std::span<const std::uint8_t> packet) const;
  [[nodiscard]] std::optional<PacketBytes> write(std::span<const std::uint8_t> packet);

  std::vector<std::uint8_t> eeprom_;
};

}  // namespace swiftlet
