// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

namespace swiftlet {

/// How a parameter is stored: the low four bits of the type byte in the table of contents.
enum class ParamType : std::uint8_t {
  kInt8 = 0,
  kInt16 = 1,
  kInt32 = 2,
  kInt64 = 3,
  kFloat = 6,
  kDouble = 7,
  kUint8 = 8,
  kUint16 = 9,
  kUint32 = 10,
  kUint64 = 11,
};
inline constexpr std::uint8_t kParamPersistent = 0x10;  ///< may be stored: "extended type" on the wire
inline constexpr std::uint8_t kParamCore = 0x20;        ///< stable, by the firmware's definition
inline constexpr std::uint8_t kParamReadOnly = 0x40;

/// Bytes on the wire.
[[nodiscard]] std::size_t param_type_size(ParamType type);

struct ParamDescription {
  std::string_view group;
  std::string_view name;
  ParamType type = ParamType::kUint8;
  std::uint8_t flags = 0;  ///< kParamPersistent, kParamCore, kParamReadOnly
  double default_value = 0.0;
};

/// The parameters of the simulated vehicle; the id of each is its index.
[[nodiscard]] std::span<const ParamDescription> simulated_param_table();

/// Precondition: there is such a parameter.
[[nodiscard]] std::uint16_t simulated_param_id(std::string_view group, std::string_view name);

/// A key that changes with the table (CRC-32 over types and names in order).
[[nodiscard]] std::uint32_t simulated_param_table_crc();

}  // namespace swiftlet
