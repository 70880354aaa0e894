// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>

namespace swiftlet {

// Captures in the layout of Bitcraze's client library: classic pcap (libpcap file format 2.4) of link type
// 162 (USER15), one CRTP packet a record, behind a short header: kind of link, direction, address, channel,
// device.

inline constexpr std::size_t kPcapFileHeader = 24;
inline constexpr std::size_t kPcapRecordHeader = 16;
inline constexpr std::uint32_t kPcapMagicMicroseconds = 0xA1B2C3D4;
inline constexpr std::uint32_t kPcapMagicNanoseconds = 0xA1B23C4D;
inline constexpr std::uint32_t kPcapLinkType = 162;

enum class CaptureLinkKind : std::uint8_t { kRadio = 1, kUsb = 2 };

/// Bytes of address in a record: radio address, or USB serial number.
constexpr std::size_t address_size(CaptureLinkKind kind) { return kind == CaptureLinkKind::kRadio ? 5 : 12; }
/// Where the CRTP packet begins in a record: after kind, direction, address, channel and device index.
constexpr std::size_t record_prefix(CaptureLinkKind kind) { return address_size(kind) + 4; }

/// Which vehicle a record belongs to: several may share one capture.
struct CaptureVehicle {
  CaptureLinkKind kind = CaptureLinkKind::kRadio;
  std::array<std::uint8_t, 12> address{};  ///< in the order of a URI's text, address_size(kind) bytes
  std::uint8_t channel = 0;                ///< 0 on USB

  bool operator==(const CaptureVehicle&) const = default;
  /// "radio E7E7E7E701 channel 80", "usb 0123456789ABCDEF01234567".
  [[nodiscard]] std::string text() const;
};

}  // namespace swiftlet
