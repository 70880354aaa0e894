// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <vector>

#include "firmware_link/simulation/packet.hpp"
#include "firmware_link/simulation/param_table.hpp"

namespace swiftlet {

/// The parameters of the vehicle's firmware (CRTP port 2, protocol version 12): table of contents, reading,
/// writing, and the commands of the misc channel with the firmware's error codes. One thread at a time;
/// allocates.
class SimulatedParams {
 public:
  SimulatedParams();

  /// Every parameter as after booting: the stored value, else the default.
  void boot();
  /// The answer to a packet of port 2; nullopt: the firmware does not answer.
  [[nodiscard]] std::optional<PacketBytes> handle(std::span<const std::uint8_t> packet);

  /// As stored in the parameter's type.
  [[nodiscard]] double number(std::uint16_t id) const;
  /// Sets a parameter aboard, also a read-only one, without a notification.
  void set(std::uint16_t id, double value);
  /// The same; returns the packet that notifies the host.
  [[nodiscard]] PacketBytes change(std::uint16_t id, double value);

 private:
  using Raw = std::uint64_t;  // the value's bytes, as on the wire

  [[nodiscard]] std::optional<PacketBytes> answer_table(std::span<const std::uint8_t> packet) const;
  [[nodiscard]] std::optional<PacketBytes> read(std::span<const std::uint8_t> packet) const;
  [[nodiscard]] std::optional<PacketBytes> write(std::span<const std::uint8_t> packet);
  [[nodiscard]] std::optional<PacketBytes> answer_misc(std::span<const std::uint8_t> packet);
  [[nodiscard]] std::optional<PacketBytes> set_by_name(std::span<const std::uint8_t> packet);
  [[nodiscard]] std::uint8_t write_by_name(std::string_view group, std::string_view name,
                                           std::span<const std::uint8_t> type_and_value);
  void put_state(PacketBytes& reply, std::uint16_t id) const;

  std::vector<Raw> values_;
  std::map<std::uint16_t, Raw> stored_;
};

}  // namespace swiftlet
