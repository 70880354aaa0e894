// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "firmware_link/crtp/log_value.hpp"

#include <array>
#include <bit>
#include <cmath>
#include <limits>

#include "core/base/check.hpp"
#include "firmware_link/crtp/byte_order.hpp"

namespace swiftlet {
namespace {

struct TypeRow {
  LogType type;
  std::string_view name;
  std::size_t size;
};
constexpr std::array<TypeRow, 8> kTypes{{{LogType::kUint8, "uint8", 1},
                                         {LogType::kUint16, "uint16", 2},
                                         {LogType::kUint32, "uint32", 4},
                                         {LogType::kInt8, "int8", 1},
                                         {LogType::kInt16, "int16", 2},
                                         {LogType::kInt32, "int32", 4},
                                         {LogType::kFloat, "float", 4},
                                         {LogType::kHalf, "half", 2}}};

const TypeRow& row_of(LogType type) {
  const auto index = static_cast<std::size_t>(type) - 1;
  SWIFTLET_CHECK(index < kTypes.size(), "a log type is one of its enumerators");
  return kTypes[index];
}

/// IEEE 754 binary16.
double decode_half(std::uint16_t bits) {
  const double sign = (bits & 0x8000) != 0 ? -1.0 : 1.0;
  const int exponent = (bits >> 10) & 0x1F;
  const int fraction = bits & 0x3FF;
  if (exponent == 0x1F) {
    return fraction == 0 ? sign * std::numeric_limits<double>::infinity()
                         : std::numeric_limits<double>::quiet_NaN();
  }
  if (exponent == 0) return sign * std::ldexp(fraction, -24);
  return sign * std::ldexp(fraction + 0x400, exponent - 25);
}

}  // namespace

std::optional<LogType> log_type_of(std::uint8_t type_byte) {
  const std::uint8_t number = type_byte & 0x0F;
  if (number < 1 || number > kTypes.size()) return std::nullopt;
  return static_cast<LogType>(number);
}

std::optional<LogType> log_type_named(std::string_view name) {
  for (const TypeRow& row : kTypes)
    if (row.name == name) return row.type;
  return std::nullopt;
}

std::size_t size_of(LogType type) { return row_of(type).size; }

double decode_log_value(LogType type, std::span<const std::uint8_t> bytes) {
  const auto raw = static_cast<std::uint32_t>(load_little_endian(bytes, 0, size_of(type)));
  switch (type) {
    case LogType::kUint8:
    case LogType::kUint16:
    case LogType::kUint32:
      return raw;
    case LogType::kInt8:
      return static_cast<std::int8_t>(raw);
    case LogType::kInt16:
      return static_cast<std::int16_t>(raw);
    case LogType::kInt32:
      return static_cast<std::int32_t>(raw);
    case LogType::kFloat:
      return static_cast<double>(std::bit_cast<float>(raw));
    case LogType::kHalf:
      return decode_half(static_cast<std::uint16_t>(raw));
  }
  return std::numeric_limits<double>::quiet_NaN();
}

}  // namespace swiftlet
