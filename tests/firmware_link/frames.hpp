// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <bit>
#include <chrono>
#include <cstdint>
#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "firmware_link/crtp/crtp_packet.hpp"
#include "firmware_link/crtp/log_value.hpp"
#include "firmware_link/link/link.hpp"
#include "firmware_link/link/link_packet.hpp"

namespace swiftlet {

using Bytes = std::vector<std::uint8_t>;

/// "5d 03 01 0a" as bytes.
inline Bytes hex(std::string_view text) {
  Bytes bytes;
  std::string digits;
  for (const char c : text)
    if (c != ' ' && c != '|') digits += c;
  for (std::size_t i = 0; i + 1 < digits.size(); i += 2)
    bytes.push_back(static_cast<std::uint8_t>(std::stoi(digits.substr(i, 2), nullptr, 16)));
  return bytes;
}

inline std::string as_text(const Bytes& bytes) { return {bytes.begin(), bytes.end()}; }
/// None of no packet.
inline Bytes packet_bytes(const std::optional<CrtpPacket>& packet) {
  return packet ? Bytes(packet->begin(), packet->end()) : Bytes{};
}

inline LinkFrame sent(const Bytes& packet, HostTime at = {}) {
  return frame_of(LinkDirection::kToVehicle, at, packet);
}
inline LinkFrame received(const Bytes& packet, HostTime at = {}) {
  return frame_of(LinkDirection::kFromVehicle, at, packet);
}

inline Bytes toc_item_reply(std::uint16_t id, LogType type, std::string_view group, std::string_view name) {
  Bytes packet{0x50, 2, low_byte(id), high_byte(id), static_cast<std::uint8_t>(type)};
  packet.insert(packet.end(), group.begin(), group.end());
  packet.push_back(0);
  packet.insert(packet.end(), name.begin(), name.end());
  packet.push_back(0);
  return packet;
}

/// A log data packet, its values appended one by one.
class LogPacket {
 public:
  LogPacket(std::uint8_t block, std::uint32_t time_ms)
      : bytes_{0x52, block, low_byte(time_ms), high_byte(time_ms), low_byte(time_ms >> 16)} {}
  LogPacket& u8(std::uint8_t value) { return put(value, 1); }
  LogPacket& u16(std::uint16_t value) { return put(value, 2); }
  LogPacket& i16(std::int16_t value) { return put(static_cast<std::uint16_t>(value), 2); }
  LogPacket& u32(std::uint32_t value) { return put(value, 4); }
  LogPacket& f32(float value) { return put(std::bit_cast<std::uint32_t>(value), 4); }
  [[nodiscard]] const Bytes& bytes() const { return bytes_; }

 private:
  LogPacket& put(std::uint32_t value, int width) {
    for (int i = 0; i < width; ++i) bytes_.push_back(static_cast<std::uint8_t>((value >> (8 * i)) & 0xFF));
    return *this;
  }
  Bytes bytes_;
};

inline HostTime host_ms(std::int64_t ms) { return HostTime(std::chrono::milliseconds(ms)); }
inline DeviceTime device_ms(std::int64_t ms) { return DeviceTime(std::chrono::milliseconds(ms)); }

}  // namespace swiftlet
