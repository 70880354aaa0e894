// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "core/base/fixed_vector.hpp"
#include "core/base/time.hpp"
#include "firmware_link/crtp/crtp_packet.hpp"
#include "firmware_link/crtp/log_value.hpp"

namespace swiftlet {

/// One variable of a log block, in the order of the block's packets.
struct LogEntry {
  std::uint16_t variable = 0;      ///< number in the table of contents
  LogType type = LogType::kUint8;  ///< as requested: its form in the packet
  std::uint8_t offset = 0;         ///< of its first byte among the values
};
/// Values of at least one byte each: no more fit.
using LogEntries = FixedVector<LogEntry, kMaxLogBytes>;

/// Appends a variable after the others; false, and nothing changed, when it does not fit.
[[nodiscard]] bool append_entry(LogEntries& entries, std::uint16_t variable, LogType type);
[[nodiscard]] std::size_t byte_count(const LogEntries& entries);

struct LogBlock {
  bool exists = false;
  /// A refused or repeated create or append: the block holds the entries up to an unknown one. The size of
  /// its packets shows how many.
  bool uncertain = false;
  bool running = false;
  Duration period{0};  ///< 0: one shot, or unknown
  LogEntries entries;
};

/// The layouts of a vehicle's log blocks, learnt from the requests and the replies of the log control channel
/// (5:1); a layout is valid from the reply on. Create and append are not atomic in the firmware: see
/// LogBlock::uncertain. Fixed storage; one thread at a time.
class LogBlockTable {
 public:
  void on_request(std::span<const std::uint8_t> packet);
  void on_reply(std::span<const std::uint8_t> packet);

  [[nodiscard]] const LogBlock& operator[](std::uint8_t id) const { return blocks_[id]; }
  /// How many of the block's entries a packet with that many value bytes holds; 0 when the layout does not
  /// explain it. A request whose reply was lost is accepted when the size confirms it.
  [[nodiscard]] std::size_t entries_in(std::uint8_t id, std::size_t value_bytes);
  /// Changes with every change of any layout.
  [[nodiscard]] std::uint32_t revision() const { return revision_; }

 private:
  /// The last create or append sent for a block, and what start asked for.
  struct Request {
    LogCommand command = LogCommand::kDelete;  ///< kCreate or kAppend; anything else: none
    bool answered = false;
    LogEntries entries;
    Duration period{0};
  };
  void apply_create(std::uint8_t id, LogError error);
  void apply_append(std::uint8_t id, LogError error);
  void forget(std::uint8_t id);
  void forget_all();

  std::array<LogBlock, 256> blocks_{};
  std::array<Request, 256> requests_{};
  bool reset_requested_ = false;  ///< and not answered
  std::uint32_t revision_ = 0;
};

}  // namespace swiftlet
