// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <span>

#include "core/base/check.hpp"
#include "core/base/fixed_vector.hpp"

namespace swiftlet {

// CRTP, the protocol of the Crazyflie firmware: a header byte (port in bits 7..4, link bits 3..2, channel in
// bits 1..0) and up to 30 data bytes, numbers little-endian.

inline constexpr std::size_t kMaxCrtpPacket = 31;
using CrtpPacket = FixedVector<std::uint8_t, kMaxCrtpPacket>;

/// A port and a channel.
struct CrtpTopic {
  std::uint8_t port = 0;
  std::uint8_t channel = 0;
};
inline constexpr CrtpTopic kParamTocTopic{2, 0};
inline constexpr CrtpTopic kParamReadTopic{2, 1};
inline constexpr CrtpTopic kLogTocTopic{5, 0};
inline constexpr CrtpTopic kLogControlTopic{5, 1};
inline constexpr CrtpTopic kLogDataTopic{5, 2};
inline constexpr CrtpTopic kPlatformVersionTopic{13, 1};
inline constexpr CrtpTopic kLinkEchoTopic{15, 0};
inline constexpr CrtpTopic kLinkSourceTopic{15, 1};

/// Commands of the tables of contents, version 2: channel 0 of the log and of the param port.
enum class TocCommand : std::uint8_t { kItem = 2, kInfo = 3 };
/// Queries of the platform version channel.
enum class VersionQuery : std::uint8_t { kProtocol = 0, kFirmware = 1, kDeviceType = 2 };
/// Commands of the log port's control channel.
enum class LogCommand : std::uint8_t {
  kDelete = 2,
  kStart = 3,
  kStop = 4,
  kReset = 5,
  kCreate = 6,
  kAppend = 7,
  kStartV2 = 8,
};
/// The errno values with which the vehicle answers log commands.
enum class LogError : std::uint8_t {
  kNone = 0,
  kUnknown = 2,         ///< ENOENT: no such block or variable
  kTooBig = 7,          ///< E2BIG: more than 26 bytes of values
  kUnknownCommand = 8,  ///< ENOEXEC
  kNoRoom = 12,         ///< ENOMEM: blocks or variables used up
  kExists = 17,         ///< EEXIST
};

/// Header, block id, 24-bit time: what precedes the values of a log data packet.
inline constexpr std::size_t kLogDataPrefix = 5;
inline constexpr std::size_t kMaxLogBytes = 26;
/// The room of the vehicle's log: blocks, and variables in all of them. The same of every firmware with this
/// log port; the reply about the table of contents tells both.
inline constexpr std::uint8_t kMaxLogBlocks = 16;
inline constexpr std::uint8_t kMaxLogVariables = 128;

/// Of a header: port and channel. Radios overwrite the others, the link bits.
inline constexpr std::uint8_t kTopicBits = 0xF3;

/// As clients send it: the link bits set, which old boot loaders insist on.
constexpr std::uint8_t crtp_header(CrtpTopic topic) {
  return static_cast<std::uint8_t>((topic.port << 4) | 0x0C | topic.channel);
}
/// Whether a packet is on that port and channel.
constexpr bool is_on(std::span<const std::uint8_t> packet, CrtpTopic topic) {
  return !packet.empty() && (packet[0] & kTopicBits) == (crtp_header(topic) & kTopicBits);
}
/// Precondition: at most 30 data bytes.
constexpr CrtpPacket make_crtp_packet(CrtpTopic topic, std::initializer_list<std::uint8_t> data) {
  SWIFTLET_CHECK(data.size() < kMaxCrtpPacket, "a packet carries at most 30 data bytes");
  CrtpPacket packet;
  static_cast<void>(packet.try_push_back(crtp_header(topic)));
  for (const std::uint8_t byte : data) static_cast<void>(packet.try_push_back(byte));
  return packet;
}
inline std::span<const std::uint8_t> bytes_of(const CrtpPacket& packet) {
  return {packet.data(), packet.size()};
}

constexpr std::uint8_t low_byte(unsigned value) { return static_cast<std::uint8_t>(value & 0xFF); }
constexpr std::uint8_t high_byte(unsigned value) { return static_cast<std::uint8_t>((value >> 8) & 0xFF); }

// The requests that swiftlet sends.
constexpr CrtpPacket source_request() { return make_crtp_packet(kLinkSourceTopic, {0}); }
constexpr CrtpPacket version_request(VersionQuery query) {
  return make_crtp_packet(kPlatformVersionTopic, {static_cast<std::uint8_t>(query)});
}
/// `topic`: kLogTocTopic or kParamTocTopic.
constexpr CrtpPacket toc_info_request(const CrtpTopic& topic) {
  return make_crtp_packet(topic, {static_cast<std::uint8_t>(TocCommand::kInfo)});
}
constexpr CrtpPacket toc_item_request(const CrtpTopic& topic, std::uint16_t id) {
  return make_crtp_packet(topic, {static_cast<std::uint8_t>(TocCommand::kItem), low_byte(id), high_byte(id)});
}
constexpr CrtpPacket param_read_request(std::uint16_t id) {
  return make_crtp_packet(kParamReadTopic, {low_byte(id), high_byte(id)});
}
constexpr CrtpPacket log_reset_request() {
  return make_crtp_packet(kLogControlTopic, {static_cast<std::uint8_t>(LogCommand::kReset)});
}
/// Create, append, delete, stop: a command for one block. Entries are appended with add_log_entry().
constexpr CrtpPacket log_block_request(LogCommand command, std::uint8_t block) {
  return make_crtp_packet(kLogControlTopic, {static_cast<std::uint8_t>(command), block});
}
/// `period_10ms` in units of 10 ms.
constexpr CrtpPacket log_start_request(std::uint8_t block, std::uint8_t period_10ms) {
  return make_crtp_packet(kLogControlTopic,
                          {static_cast<std::uint8_t>(LogCommand::kStart), block, period_10ms});
}
/// To a create or append request: 3 bytes, so 9 fit beside header, command and block id. False, and the
/// request unchanged, when it is full.
[[nodiscard]] constexpr bool add_log_entry(CrtpPacket& request, std::uint8_t type, std::uint16_t variable) {
  if (request.size() + 3 > kMaxCrtpPacket - 1) return false;
  return request.try_push_back(type) && request.try_push_back(low_byte(variable)) &&
         request.try_push_back(high_byte(variable));
}

}  // namespace swiftlet
