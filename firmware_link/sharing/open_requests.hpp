// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "core/base/fixed_vector.hpp"
#include "firmware_link/crtp/crtp_packet.hpp"

namespace swiftlet {

/// Whether an answer on that topic belongs to whoever asked, among several who ask for the same kind of
/// thing: source, version, tables of contents, parameter reads, echoes.
[[nodiscard]] bool answers_a_request(std::span<const std::uint8_t> packet);
/// A table of contents has no item of the number asked for; the answer does not repeat the number.
[[nodiscard]] bool is_missing_item(std::span<const std::uint8_t> answer);

/// The requests of one party that the vehicle has not answered yet, by what an answer repeats of them. Of too
/// many, the oldest are forgotten. Fixed storage; one thread at a time.
class OpenRequests {
 public:
  /// Without effect on packets that no answer is matched to.
  void sent(std::span<const std::uint8_t> request);
  /// Whether this party asked for it; if so, its oldest request is no longer open.
  [[nodiscard]] bool take_answer(std::span<const std::uint8_t> answer);
  void clear() { open_.clear(); }

 private:
  static constexpr std::size_t kCapacity = 32;
  FixedVector<CrtpPacket, kCapacity> open_;  ///< the part of each that its answer repeats
};

}  // namespace swiftlet
