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
#include "swiftlet/status_t.hpp"

namespace swiftlet {

/// Reads the numbers of elements that a message claims, which LCM's own code makes room for before it looks
/// whether they are there, and the lengths of names, of which it takes a negative one for 2 GB.
class ClaimedCounts {
 public:
  /// The first number stands at byte `at`.
  ClaimedCounts(std::span<const std::uint8_t> bytes, std::size_t at) : bytes_(bytes), at_(at) {}

  /// The next number; nullopt: there is none, or the message cannot hold as many.
  std::optional<std::size_t> next() {
    constexpr std::size_t kNumberBytes = 4;
    if (at_ > bytes_.size() || bytes_.size() - at_ < kNumberBytes) return std::nullopt;
    std::uint32_t number = 0;
    for (const std::uint8_t byte : bytes_.subspan(at_, kNumberBytes)) number = number << 8U | byte;
    at_ += kNumberBytes;
    return number <= bytes_.size() ? std::optional<std::size_t>(number) : std::nullopt;
  }
  /// Passes a list of elements that are each a name and so many bytes more. False: it cannot be there.
  [[nodiscard]] bool skip_named(std::size_t bytes_beside_name) {
    std::optional<std::size_t> left = next();
    for (; left && *left > 0; --*left) {
      const std::optional<std::size_t> name_bytes = next();
      if (!name_bytes) return false;
      at_ += *name_bytes + bytes_beside_name;
    }
    return left.has_value();
  }

 private:
  std::span<const std::uint8_t> bytes_;
  std::size_t at_;
};

/// Whether a message can hold as many elements as it claims to.
template <typename Message>
[[nodiscard]] bool can_hold_its_counts(std::span<const std::uint8_t>) {
  return true;
}
template <>
[[nodiscard]] inline bool can_hold_its_counts<ranges_t>(std::span<const std::uint8_t> bytes) {
  constexpr std::size_t kCountAt = 40;
  return ClaimedCounts(bytes, kCountAt).next().has_value();
}
template <>
[[nodiscard]] inline bool can_hold_its_counts<landmarks_t>(std::span<const std::uint8_t> bytes) {
  constexpr std::size_t kCountAt = 32;
  return ClaimedCounts(bytes, kCountAt).next().has_value();
}
/// Of queues, and behind them of stages.
template <>
[[nodiscard]] inline bool can_hold_its_counts<status_t>(std::span<const std::uint8_t> bytes) {
  constexpr std::size_t kCountAt = 386;
  constexpr std::size_t kBytesOfQueue = 16;  // beside its name
  constexpr std::size_t kBytesOfStage = 48;
  ClaimedCounts counts(bytes, kCountAt);
  return counts.skip_named(kBytesOfQueue) && counts.skip_named(kBytesOfStage);
}

/// A message of the LCM type; nullopt where the bytes are not one, or one of another version.
template <typename Message>
[[nodiscard]] std::optional<Message> decoded_message(std::span<const std::uint8_t> bytes) {
  if (!can_hold_its_counts<Message>(bytes)) return std::nullopt;
  std::optional<Message> message(std::in_place);
  try {
    if (message->decode(bytes.data(), 0, static_cast<int>(bytes.size())) < 0) message.reset();
  } catch (const std::exception&) {
    message.reset();
  }
  return message;
}

}  // namespace swiftlet
