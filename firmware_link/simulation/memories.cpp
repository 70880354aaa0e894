// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "firmware_link/simulation/memories.hpp"

#include <algorithm>
#include <array>
#include <numeric>

#include "firmware_link/crtp/byte_order.hpp"

namespace swiftlet {
namespace {

// The firmware builds these headers itself: their link bits are 0.
constexpr std::uint8_t kInfoHeader = 0x40;
constexpr std::uint8_t kReadHeader = 0x41;
constexpr std::uint8_t kWriteHeader = 0x42;

enum InfoCommand : std::uint8_t { kCount = 1, kDetails = 2 };
enum MemoryId : std::uint8_t { kEeprom = 0, kTester = 1, kMemories = 2 };
constexpr std::uint8_t kEepromType = 0x00;
constexpr std::uint8_t kTesterType = 0x15;
constexpr std::size_t kEepromBytes = 8192;
constexpr std::size_t kTesterBytes = 4096;
constexpr std::uint8_t kIoError = 5;  // EIO

constexpr std::size_t kRequestHead = 6;  // header, memory, address: the beginning of reads and writes
constexpr std::size_t kMaxRead = kMaxCrtpPacket - kRequestHead - 1;

/// Channel, data rate, trims of pitch and roll, address; ends with the sum of what precedes.
std::array<std::uint8_t, 21> radio_settings() {
  std::array<std::uint8_t, 21> block{'0', 'x', 'B', 'C', 1,    80,   2,    0,    0,    0, 0,
                                     0,   0,   0,   0,   0xE7, 0xE7, 0xE7, 0xE7, 0xE7, 0};
  block.back() = static_cast<std::uint8_t>(std::accumulate(block.begin(), block.end() - 1, 0U));
  return block;
}

}  // namespace

SimulatedMemories::SimulatedMemories() : eeprom_(kEepromBytes, 0xFF) {
  std::ranges::copy(radio_settings(), eeprom_.begin());
}

std::optional<PacketBytes> SimulatedMemories::handle(std::span<const std::uint8_t> packet) {
  switch (packet[0] & 0x03U) {
    case 0:
      return answer_info(packet);
    case 1:
      return read(packet);
    case 2:
      return write(packet);
    default:
      return std::nullopt;
  }
}

std::optional<PacketBytes> SimulatedMemories::answer_info(std::span<const std::uint8_t> packet) {
  if (packet.size() < 2) return std::nullopt;
  PacketBytes reply;
  put(reply, kInfoHeader);
  put(reply, packet[1]);
  if (packet[1] == kCount) {
    put(reply, kMemories);
    return reply;
  }
  if (packet[1] != kDetails || packet.size() < 3) return std::nullopt;
  put(reply, packet[2]);
  if (packet[2] >= kMemories) return reply;  // an answer without contents means: no such memory
  const bool is_eeprom = packet[2] == kEeprom;
  put(reply, is_eeprom ? kEepromType : kTesterType);
  put_little_endian(reply, is_eeprom ? kEepromBytes : kTesterBytes, 4);
  put_little_endian(reply, 0, 8);  // serial number: memories of decks have one
  return reply;
}

std::optional<PacketBytes> SimulatedMemories::read(std::span<const std::uint8_t> packet) const {
  if (packet.size() < kRequestHead + 1) return std::nullopt;
  const std::uint8_t memory = packet[1];
  const std::uint32_t address = load_u32(packet, 2);
  const std::size_t length = packet[kRequestHead];
  const std::uint64_t end = std::uint64_t{address} + length;
  const bool is_possible =
      length <= kMaxRead && ((memory == kEeprom && end <= eeprom_.size()) || memory == kTester);
  PacketBytes reply;
  put(reply, kReadHeader);
  put_bytes(reply, packet.subspan(1, kRequestHead - 1));
  put(reply, is_possible ? std::uint8_t{0} : kIoError);
  if (!is_possible) return reply;
  for (std::uint64_t at = address; at < end; ++at)
    put(reply, memory == kEeprom ? eeprom_[static_cast<std::size_t>(at)] : static_cast<std::uint8_t>(at));
  return reply;
}

std::optional<PacketBytes> SimulatedMemories::write(std::span<const std::uint8_t> packet) {
  if (packet.size() < kRequestHead) return std::nullopt;
  const std::span<const std::uint8_t> data = packet.subspan(kRequestHead);
  const std::size_t address = load_u32(packet, 2);
  const bool fits_eeprom =
      packet[1] == kEeprom && address <= eeprom_.size() && data.size() <= eeprom_.size() - address;
  if (fits_eeprom) std::ranges::copy(data, eeprom_.begin() + static_cast<std::ptrdiff_t>(address));
  PacketBytes reply;
  put(reply, kWriteHeader);
  put_bytes(reply, packet.subspan(1, kRequestHead - 1));
  put(reply, fits_eeprom || packet[1] == kTester ? std::uint8_t{0} : kIoError);
  return reply;
}

}  // namespace swiftlet
