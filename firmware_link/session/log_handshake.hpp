// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/base/result.hpp"
#include "core/base/time.hpp"
#include "firmware_link/crtp/crtp_packet.hpp"
#include "firmware_link/session/log_session.hpp"
#include "firmware_link/session/pending_request.hpp"
#include "firmware_link/session/toc_cache.hpp"
#include "firmware_link/session/toc_download.hpp"

namespace swiftlet {

/// The lowest CRTP protocol version with this log port, and the newest one known.
inline constexpr int kOldestProtocol = 4;
inline constexpr int kNewestProtocol = 12;
/// What the handshake makes at most: blocks, numbered from 1, and variables in all of them.
inline constexpr std::size_t kMaxOwnLogBlocks = 3;
inline constexpr std::size_t kMaxOwnLogVariables = 25;

/// Starts the log of a live vehicle: determines the next request from the replies. One is outstanding, of
/// the table of contents several; what is not answered is repeated. Source, protocol version, reset of the
/// log, table of contents, then creates and starts the blocks: pose, ranges and tilt at 10 Hz, the vehicle's
/// health at 1 Hz. No link, no clock: the caller passes the time. One thread at a time; allocates; `session`
/// must outlive it and receive each packet first, `cache` must outlive it.
class LogHandshake {
 public:
  LogHandshake(const LogSession& session, TocCache& cache);

  /// The packet to send now, if any.
  [[nodiscard]] std::optional<CrtpPacket> next_request(HostTime now);
  /// A packet from the vehicle.
  void on_frame(std::span<const std::uint8_t> packet, HostTime at);
  /// If the table of contents came from the cache: the replies that the vehicle would have sent, for all that
  /// learn from replies. Empty afterwards.
  [[nodiscard]] std::vector<CrtpPacket> take_cached_replies() { return std::exchange(cached_replies_, {}); }

  /// The share of the table of contents that is downloaded, while it is.
  [[nodiscard]] std::optional<double> toc_progress() const {
    return step_ == Step::kToc ? std::optional(toc_->progress()) : std::nullopt;
  }
  /// All blocks are started: log data flows.
  [[nodiscard]] bool finished() const { return step_ == Step::kFinished; }
  /// The blocks that samples are made of. Once finished().
  [[nodiscard]] std::vector<std::uint8_t> essential_blocks() const;
  /// Why this vehicle cannot be used; final: it refused four times in the same way. Lost packets and
  /// garbage are no failure.
  [[nodiscard]] const std::optional<Error>& failure() const { return failure_; }
  /// CRTP protocol version; 0 until received. kNewestProtocol is the newest that swiftlet was tried with.
  [[nodiscard]] int protocol() const { return protocol_; }

 private:
  enum class Step { kSource, kVersion, kReset, kToc, kBlocks, kFinished, kFailed };
  struct PlannedBlock {
    std::uint8_t id = 0;
    bool optional = false;             ///< samples do not need it: if refused, it is left out
    std::vector<CrtpPacket> requests;  ///< create, append as needed, start
  };

  void enter(Step step);
  void refuse(std::string message, std::span<const std::uint8_t> answer = {});
  void fail(Error why);
  void on_source(std::span<const std::uint8_t> packet);
  void on_version(std::span<const std::uint8_t> packet);
  void on_toc(std::span<const std::uint8_t> packet, HostTime at);
  void on_reset(std::span<const std::uint8_t> packet);
  void on_block_reply(std::span<const std::uint8_t> packet);
  void restate_cached_toc();
  void plan_blocks();
  bool plan_block(std::uint8_t id, std::uint8_t period_10ms, std::span<const std::string_view> required,
                  std::span<const std::string_view> optional);
  void answer_refusal(LogCommand command, LogError error);
  void next_block_request();
  void next_block();
  void send_block_request();
  void remake_block();

  const LogSession* session_;
  TocCache* cache_;
  Step step_ = Step::kSource;
  PendingRequest request_;
  int protocol_ = 0;
  std::optional<TocDownload> toc_;
  std::vector<CrtpPacket> cached_replies_;
  std::vector<PlannedBlock> plan_;
  std::size_t block_ = 0;          ///< of the plan
  std::size_t block_request_ = 0;  ///< of the block
  std::string refusal_;            ///< the last one, and the answer that it was read from
  int asks_again_ = 0;             ///< from the beginning, after this refusal
  bool awaits_source_ = false;     ///< the last request has not been answered
  int append_patience_ = 1;        ///< in usual waits
  std::optional<Error> failure_;
};

}  // namespace swiftlet
