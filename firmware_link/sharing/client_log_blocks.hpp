// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "core/base/fixed_vector.hpp"
#include "core/base/time.hpp"
#include "firmware_link/crtp/crtp_packet.hpp"
#include "firmware_link/session/log_handshake.hpp"

namespace swiftlet {

/// The log blocks of a client on a vehicle whose log is shared. The client has numbers of its own, which are
/// translated; it can neither reach the owner's blocks nor use up the room that they need. What it asks
/// beyond that is answered here as the vehicle would. Its reset deletes its own blocks only, and is answered
/// when they are gone. Fixed storage; one thread at a time.
class ClientLogBlocks {
 public:
  /// The client's blocks have these numbers on the vehicle, the owner's smaller ones.
  static constexpr std::uint8_t kFirstBlock = 16;
  static constexpr std::size_t kMaxBlocks = kMaxLogBlocks - kMaxOwnLogBlocks;
  static constexpr std::size_t kMaxVariables = kMaxLogVariables - kMaxOwnLogVariables;

  [[nodiscard]] static constexpr bool has_number(std::uint8_t block) {
    return block >= kFirstBlock && block < kFirstBlock + kMaxBlocks;
  }

  /// What becomes of a client's request on kLogControlTopic: to be sent, answered at once, or (neither) it
  /// waits for deletions, or is none.
  struct Outcome {
    std::optional<CrtpPacket> request;
    std::optional<CrtpPacket> answer;
  };
  [[nodiscard]] Outcome on_request(std::span<const std::uint8_t> packet);
  /// The vehicle's answer on kLogControlTopic about a block with a client's number, for the client; nullopt:
  /// it did not ask.
  [[nodiscard]] std::optional<CrtpPacket> on_answer(std::span<const std::uint8_t> packet);
  /// A packet on kLogDataTopic as the client knows it; nullopt: of a block that it has not.
  [[nodiscard]] std::optional<CrtpPacket> on_data(std::span<const std::uint8_t> packet) const;

  /// The next deletion of a block that is to go, sent again after 200 ms without an answer.
  [[nodiscard]] std::optional<CrtpPacket> next_deletion(HostTime now);
  [[nodiscard]] bool deletion_is_due(HostTime now) const;
  /// A reset waits for its deletions. No request of the client is to be sent before it is answered.
  [[nodiscard]] bool is_resetting() const { return reset_.has_value(); }
  /// The answer to a reset whose deletions are done, once.
  [[nodiscard]] std::optional<CrtpPacket> take_reset_answer();

  /// The client is gone: so are its blocks, once the vehicle is reached.
  void abandon();
  /// The vehicle has reset its log: there are none. Whether the client has lost one that way.
  [[nodiscard]] bool forget_all();

 private:
  struct Block {
    std::uint8_t clients = 0;   ///< number
    std::uint8_t vehicles = 0;  ///< number
    std::size_t variables = 0;  ///< at most
    bool is_doomed = false;
    HostTime deletion_sent_at = HostTime::min();
  };

  [[nodiscard]] Outcome create(std::span<const std::uint8_t> packet);
  [[nodiscard]] Outcome append(std::span<const std::uint8_t> packet, Block& block);
  [[nodiscard]] Outcome forward(std::span<const std::uint8_t> packet, const Block& block) const;
  [[nodiscard]] Block* find(std::uint8_t clients);
  [[nodiscard]] bool has_room_for(std::size_t variables) const;
  [[nodiscard]] std::uint8_t free_number();

  FixedVector<Block, kMaxBlocks> blocks_;
  std::uint8_t last_number_ = kFirstBlock;  ///< on the vehicle, given last
  std::optional<CrtpPacket> reset_;         ///< as it was asked for
};

}  // namespace swiftlet
