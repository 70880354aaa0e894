// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <algorithm>
#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/base/time.hpp"
#include "firmware_link/crtp/crtp_packet.hpp"
#include "firmware_link/link/link.hpp"

namespace swiftlet {

/// The bytes that a fuzzer makes up, read as numbers and frames. When they are used up, all is zero.
class FuzzBytes {
 public:
  explicit FuzzBytes(std::span<const std::uint8_t> bytes) : left_(bytes) {}

  [[nodiscard]] bool used_up() const { return left_.empty(); }
  std::uint8_t byte() {
    if (left_.empty()) return 0;
    const std::uint8_t first = left_.front();
    left_ = left_.subspan(1);
    return first;
  }
  /// Bytes 0: size in bits 0..4, direction in bit 7. 1: milliseconds since the frame before. Then the packet.
  LinkFrame frame() {
    const std::uint8_t control = byte();
    now_ += std::chrono::milliseconds(byte());
    LinkFrame frame;
    frame.at = now_;
    frame.direction = (control & 0x80) != 0 ? LinkDirection::kToVehicle : LinkDirection::kFromVehicle;
    frame.size = std::clamp<std::uint8_t>(control & 0x1F, 1, kMaxCrtpPacket);
    for (std::size_t i = 0; i < frame.size; ++i) frame.bytes[i] = byte();
    return frame;
  }

 private:
  std::span<const std::uint8_t> left_;
  HostTime now_{};
};

/// As FuzzBytes::frame() reads them.
inline std::vector<std::uint8_t> as_fuzz_bytes(std::span<const LinkFrame> frames) {
  std::vector<std::uint8_t> bytes;
  HostTime before = frames.empty() ? HostTime{} : frames.front().at;
  for (const LinkFrame& frame : frames) {
    const std::uint8_t direction = frame.direction == LinkDirection::kToVehicle ? 0x80 : 0;
    bytes.push_back(static_cast<std::uint8_t>(direction | frame.size));
    const std::int64_t ms = (frame.at - before) / std::chrono::milliseconds(1);
    bytes.push_back(static_cast<std::uint8_t>(std::clamp<std::int64_t>(ms, 0, 255)));
    bytes.insert(bytes.end(), frame.packet().begin(), frame.packet().end());
    before = frame.at;
  }
  return bytes;
}

}  // namespace swiftlet
