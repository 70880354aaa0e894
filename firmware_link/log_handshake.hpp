// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/result.hpp"
#include "core/base/time.hpp"
#include "firmware_link/crtp_packet.hpp"
#include "firmware_link/log_session.hpp"

namespace swiftlet {

/// The lowest CRTP protocol version with this log port, and the newest one known.
inline constexpr int kOldestProtocol = 4;
inline constexpr int kNewestProtocol = 12;

/// Brings a live vehicle to send what samples need: says which request to send next, one outstanding,
/// repeated after 200 ms; learns from the replies. Source, protocol version, reset of the log, table of
/// contents, then creates and starts the blocks at 10 Hz. No I/O, no clock: it is told the time. One thread
/// at a time; allocates; `session` must outlive it and hear each packet first.
class LogHandshake {
 public:
  explicit LogHandshake(const LogSession& session);

  /// The packet to send now, if any.
  [[nodiscard]] std::optional<CrtpPacket> next_request(HostTime now);
  /// A packet from the vehicle.
  void hear(std::span<const std::uint8_t> packet);

  /// All blocks are started: log data flows.
  [[nodiscard]] bool finished() const { return step_ == Step::kFinished; }
  /// Why this vehicle cannot be used; final.
  [[nodiscard]] const std::optional<Error>& failure() const { return failure_; }
  [[nodiscard]] const std::vector<std::string>& notes() const { return notes_; }

 private:
  enum class Step { kSource, kVersion, kReset, kTocInfo, kTocItems, kBlocks, kFinished, kFailed };
  struct PlannedBlock {
    std::uint8_t id = 0;
    std::vector<CrtpPacket> requests;  ///< create, append as needed, start
  };

  void enter(Step step);
  void request(const CrtpPacket& packet);
  void fail(std::string message);
  void hear_version(std::span<const std::uint8_t> packet);
  void hear_toc(std::span<const std::uint8_t> packet);
  void ask_next_item();
  void plan_blocks();
  bool plan_block(std::uint8_t id, std::span<const std::string_view> required,
                  std::span<const std::string_view> optional);
  void hear_control(std::span<const std::uint8_t> packet);
  void hear_block_reply(LogCommand command, LogError error);
  void send_block_request();
  void remake_block();

  const LogSession& session_;
  Step step_ = Step::kSource;
  std::optional<CrtpPacket> request_;
  std::optional<HostTime> sent_at_;
  std::uint16_t item_ = 0;
  std::vector<PlannedBlock> plan_;
  std::size_t block_ = 0;          ///< of the plan
  std::size_t block_request_ = 0;  ///< of the block
  bool deleting_ = false;          ///< the block is being deleted, to be made anew
  std::size_t remakes_ = 0;
  std::optional<Error> failure_;
  std::vector<std::string> notes_;
};

}  // namespace swiftlet
