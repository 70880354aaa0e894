// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <vector>

#include "core/base/time.hpp"
#include "firmware_link/crtp/crtp_packet.hpp"
#include "firmware_link/simulation/log_table.hpp"
#include "firmware_link/simulation/packet.hpp"
#include "firmware_link/simulation/random.hpp"

namespace swiftlet {

/// The log service of the vehicle's firmware (CRTP port 5, protocol version 12): table of contents, log
/// blocks with the firmware's limits and error codes, and their packets. One thread at a time; allocates.
class SimulatedLog {
 public:
  using Milliseconds = std::chrono::milliseconds;

  /// The vehicle's clock when its packets are stamped jitters by +-1 ms. Noise source: "log_jitter/<block>".
  explicit SimulatedLog(std::uint64_t seed) : seed_(seed) {}

  [[nodiscard]] bool has_running_block() const;
  /// Deletes all blocks, as the firmware does when the radio is silent.
  void clear() { blocks_.clear(); }
  /// The answer to a packet of port 5, received at `now` (since boot); nullopt: the firmware does not answer.
  [[nodiscard]] std::optional<PacketBytes> handle(std::span<const std::uint8_t> packet, Milliseconds now);
  /// The packets of all blocks that are due at `now`, in the order of block ids. To be called each
  /// millisecond.
  [[nodiscard]] std::vector<PacketBytes> sample(Milliseconds now, const VehicleState& state);

 private:
  struct Entry {
    LogType fetch_type;
    std::uint16_t variable;
  };
  struct Block {
    std::vector<Entry> entries;
    Milliseconds period{0};  // 0: not running
    Milliseconds beat{0};    // the block's next even beat...
    Milliseconds due{0};     // ...and when it is really sampled
    bool one_shot_due = false;
    NoiseSource jitter;
    void schedule_after(Milliseconds now);
  };

  [[nodiscard]] LogError control(std::span<const std::uint8_t> packet, Milliseconds now);
  [[nodiscard]] LogError create(std::uint8_t id, std::span<const std::uint8_t> entries);
  [[nodiscard]] LogError append(std::uint8_t id, std::span<const std::uint8_t> entries);
  [[nodiscard]] LogError start(std::uint8_t id, Milliseconds period, Milliseconds now);
  [[nodiscard]] LogError stop(std::uint8_t id);
  [[nodiscard]] static PacketBytes data_packet(std::uint8_t id, const Block& block, Milliseconds now,
                                               const VehicleState& state);
  [[nodiscard]] std::size_t entries_in_use() const;

  std::uint64_t seed_;
  std::map<std::uint8_t, Block> blocks_;
};

}  // namespace swiftlet
