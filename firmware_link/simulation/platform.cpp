// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "firmware_link/simulation/platform.hpp"

namespace swiftlet {
namespace {

constexpr std::uint8_t kProtocolVersion = 12;
enum PlatformChannel : std::uint8_t { kPlatformCommand = 0, kVersion = 1 };
enum PlatformCommand : std::uint8_t { kPlatformArm = 1, kPlatformRecover = 2, kNotifyUser = 3 };
enum VersionCommand : std::uint8_t { kProtocol = 0, kFirmware = 1, kDeviceType = 2 };
enum LinkChannel : std::uint8_t { kEcho = 0, kSource = 1 };

enum SupervisorChannel : std::uint8_t { kState = 0, kCommand = 1 };
constexpr std::uint8_t kLastSingleState = 0x0B;  // states 1 to 11 are the bits 0 to 10
constexpr std::uint8_t kAllStates = 0x0C;
enum SupervisorCommand : std::uint8_t { kArm = 1, kRecover = 2 };
constexpr std::uint8_t kAnswer = 0x80;
constexpr std::uint8_t kPortAndChannel = 0xF3;

unsigned channel_of(std::span<const std::uint8_t> packet) { return packet[0] & 0x03U; }

/// A vehicle that arms itself cannot be disarmed.
bool arming_succeeds(std::span<const std::uint8_t> packet) { return packet.size() > 2 && packet[2] != 0; }

/// Each command is answered in its own buffer; the firmware drops the second byte of two of the results.
PacketBytes answer_platform_command(std::span<const std::uint8_t> packet) {
  switch (packet[1]) {
    case kPlatformArm:
    case kPlatformRecover: {
      PacketBytes reply = head_of(packet, 2);
      put(reply, packet[1] == kPlatformRecover || arming_succeeds(packet) ? 1 : 0);
      return reply;
    }
    case kNotifyUser:
      return head_of(packet, 1);
    default:
      return head_of(packet, packet.size());
  }
}

}  // namespace

std::optional<PacketBytes> answer_link_service(std::span<const std::uint8_t> packet) {
  if (channel_of(packet) == kEcho) return head_of(packet, packet.size());
  if (channel_of(packet) != kSource) return std::nullopt;
  PacketBytes reply = head_of(packet, 1);
  put_characters(reply, "Bitcraze Crazyflie");  // clients identify a Crazyflie by this text
  while (!reply.full()) put(reply, 0);
  return reply;
}

std::optional<PacketBytes> answer_platform_service(std::span<const std::uint8_t> packet) {
  if (packet.size() < 2) return std::nullopt;
  if (channel_of(packet) == kPlatformCommand) return answer_platform_command(packet);
  if (channel_of(packet) != kVersion) return std::nullopt;
  PacketBytes reply = head_of(packet, 2);
  switch (packet[1]) {
    case kProtocol:
      put_little_endian(reply, kProtocolVersion, 4);
      return reply;
    case kFirmware:
      put_characters(reply, "swiftlet simulation");
      return reply;
    case kDeviceType:
      put_characters(reply, "Crazyflie 2.1");
      return reply;
    default:
      return std::nullopt;
  }
}

std::uint16_t supervisor_info(bool is_flying) { return is_flying ? 0x1F : 0x0F; }

std::optional<PacketBytes> answer_supervisor_service(std::span<const std::uint8_t> packet, bool is_flying) {
  if (packet.size() < 2) return std::nullopt;
  const std::uint8_t command = packet[1];
  PacketBytes reply;
  put(reply, packet[0] & kPortAndChannel);  // a packet of its own: its link bits are 0
  put(reply, command | kAnswer);
  if (channel_of(packet) == kState) {
    const unsigned info = supervisor_info(is_flying);
    if (command == kAllStates) {
      put_little_endian(reply, info, 2);
      return reply;
    }
    if (command == 0 || command > kLastSingleState) return std::nullopt;
    put(reply, (info >> (command - 1U) & 1U) != 0 ? 1 : 0);
    return reply;
  }
  const bool is_answered = channel_of(packet) == kCommand && (command == kArm || command == kRecover);
  if (!is_answered) return std::nullopt;
  put(reply, command == kRecover || arming_succeeds(packet) ? 1 : 0);
  put(reply, 1);  // it is armed, or not crashed
  return reply;
}

}  // namespace swiftlet
