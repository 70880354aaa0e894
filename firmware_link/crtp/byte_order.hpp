// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "core/base/check.hpp"

namespace swiftlet {

/// The unsigned number in bytes offset .. offset + width - 1. Precondition: they lie inside `bytes`.
constexpr std::uint64_t load_little_endian(std::span<const std::uint8_t> bytes, std::size_t offset,
                                           std::size_t width) {
  SWIFTLET_CHECK(offset + width <= bytes.size(), "the number lies inside the bytes");
  std::uint64_t value = 0;
  for (std::size_t i = width; i > 0; --i) value = (value << 8) | bytes[offset + i - 1];
  return value;
}
constexpr std::uint64_t load_big_endian(std::span<const std::uint8_t> bytes, std::size_t offset,
                                        std::size_t width) {
  SWIFTLET_CHECK(offset + width <= bytes.size(), "the number lies inside the bytes");
  std::uint64_t value = 0;
  for (std::size_t i = 0; i < width; ++i) value = (value << 8) | bytes[offset + i];
  return value;
}

constexpr std::uint16_t load_u16(std::span<const std::uint8_t> bytes, std::size_t offset) {
  return static_cast<std::uint16_t>(load_little_endian(bytes, offset, 2));
}
constexpr std::uint32_t load_u32(std::span<const std::uint8_t> bytes, std::size_t offset) {
  return static_cast<std::uint32_t>(load_little_endian(bytes, offset, 4));
}

}  // namespace swiftlet
