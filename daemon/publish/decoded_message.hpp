// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <exception>
#include <optional>
#include <span>

#include "swiftlet/landmarks_t.hpp"
#include "swiftlet/ranges_t.hpp"

namespace swiftlet {

/// The byte at which an encoded message (proto/) has the number of elements of its lists; 0: it has no lists.
template <typename Message>
inline constexpr std::size_t kCountAt = 0;
template <>
inline constexpr std::size_t kCountAt<ranges_t> = 40;
template <>
inline constexpr std::size_t kCountAt<landmarks_t> = 32;

/// Whether a message can hold as many elements as it claims to. LCM's own code makes room for them first.
[[nodiscard]] inline bool can_hold_its_count(std::span<const std::uint8_t> bytes, std::size_t count_at) {
  constexpr std::size_t kCountBytes = 4;
  if (bytes.size() < count_at + kCountBytes) return false;
  std::uint32_t count = 0;
  for (const std::uint8_t byte : bytes.subspan(count_at, kCountBytes)) count = count << 8U | byte;
  return count <= bytes.size();
}

/// A message of the LCM type; nullopt where the bytes are not one, or one of another version.
template <typename Message>
[[nodiscard]] std::optional<Message> decoded_message(std::span<const std::uint8_t> bytes) {
  constexpr std::size_t kAt = kCountAt<Message>;
  if (kAt > 0 && !can_hold_its_count(bytes, kAt)) return std::nullopt;
  std::optional<Message> message(std::in_place);
  try {
    if (message->decode(bytes.data(), 0, static_cast<int>(bytes.size())) < 0) message.reset();
  } catch (const std::exception&) {
    message.reset();
  }
  return message;
}

}  // namespace swiftlet
