// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

namespace swiftlet {

/// Types of log variables as the table of contents numbers them; kHalf: only as the type that a block
/// requests.
enum class LogType : std::uint8_t {
  kUint8 = 1,
  kUint16 = 2,
  kUint32 = 3,
  kInt8 = 4,
  kInt16 = 5,
  kInt32 = 6,
  kFloat = 7,
  kHalf = 8,
};

/// From the low four bits of a type byte; nullopt for an undefined number.
[[nodiscard]] std::optional<LogType> log_type_of(std::uint8_t type_byte);
/// "uint16", "float", "half" and so on; nullopt for an unknown name.
[[nodiscard]] std::optional<LogType> log_type_named(std::string_view name);
/// Bit of supervisor.info.
inline constexpr unsigned kSupervisorFlying = 1U << 4U;

/// Bytes on the wire, 1 to 4.
[[nodiscard]] std::size_t size_of(LogType type);
/// The value at the start of `bytes`, exactly: every type fits a double. Precondition: size_of(type) bytes.
[[nodiscard]] double decode_log_value(LogType type, std::span<const std::uint8_t> bytes);

}  // namespace swiftlet
