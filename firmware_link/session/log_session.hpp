// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/time.hpp"
#include "firmware_link/link/link.hpp"
#include "firmware_link/session/block_description.hpp"
#include "firmware_link/session/device_clock.hpp"
#include "firmware_link/session/log_block_table.hpp"
#include "firmware_link/session/log_toc.hpp"

namespace swiftlet {

/// A log data packet whose layout is known. References the session and its frame: valid until the next
/// on_frame().
struct LogRecord {
  std::uint8_t block_id = 0;
  const LogBlock* block = nullptr;
  bool described = false;       ///< the layout is the description's, not the capture's
  std::size_t entry_count = 0;  ///< entries of the block that this packet holds
  std::uint32_t boot = 0;       ///< counts the vehicle's reboots: times of two boots are not comparable
  DeviceTime at{};
  HostTime received{};
  std::span<const std::uint8_t> values;

  /// Precondition: i < entry_count.
  [[nodiscard]] double value(std::size_t i) const {
    const LogEntry& entry = block->entries[i];
    return decode_log_value(entry.type, values.subspan(entry.offset));
  }
};

/// Log packets that could not be read, by reason.
struct UnreadableRecords {
  std::uint64_t unknown_block = 0;  ///< the contents of the block, or their names, are unknown
  std::uint64_t misfit = 0;         ///< its size is not that of the layout
  std::uint64_t wrong_time = 0;     ///< its stamp is not of the vehicle's clock
};

/// The vehicle's 24-bit clock in a log packet, and when the packet was received.
struct LogStamp {
  std::uint32_t counter_ms = 0;
  HostTime received{};
};

/// Learns from both directions of a link what the vehicle's log packets hold: table of contents, block
/// layouts, start and stop; then decodes the packets. No I/O, no clock; works the same on a live link and on
/// a recording. One thread at a time; allocates while it learns names, not on log data.
class LogSession {
 public:
  /// For blocks that the traffic does not name. Call before on_frame().
  void describe(const BlockDescription& description);

  /// Learns from a frame. Returns a record if it is log data that can be read.
  [[nodiscard]] std::optional<LogRecord> on_frame(const LinkFrame& frame);
  /// Learns from a request to the vehicle. The same one twice is harmless.
  void on_request(std::span<const std::uint8_t> packet);

  [[nodiscard]] const LogToc& toc() const { return toc_; }
  [[nodiscard]] const LogBlockTable& blocks() const { return blocks_; }
  /// "group.name"; empty when unknown. Valid until the next on_frame().
  [[nodiscard]] std::string_view name_of(const LogRecord& record, std::size_t entry) const;
  /// Changes with every change of a layout or of a name: what was derived from them must be derived again.
  [[nodiscard]] std::uint32_t revision() const { return blocks_.revision() + toc_revision_; }
  [[nodiscard]] bool used_description() const { return used_description_; }
  [[nodiscard]] const UnreadableRecords& unreadable() const { return unreadable_; }

 private:
  void on_toc_reply(std::span<const std::uint8_t> packet);
  std::optional<LogRecord> read(const LinkFrame& frame);
  /// Sets the layout of a record whose block and size fit one; counts it otherwise.
  bool find_layout(LogRecord& record);
  std::optional<DeviceTime> time_of(const LogStamp& stamp);
  [[nodiscard]] bool continues(const LogStamp& stamp) const;
  [[nodiscard]] bool host_clock_has_stepped(const LogStamp& stamp);
  [[nodiscard]] bool is_confirmed(const LogStamp& stamp) const;
  /// Whether the first `entry_count` entries exist and have names.
  [[nodiscard]] bool is_named(const LogBlock& block, std::size_t entry_count) const;

  LogToc toc_;
  LogBlockTable blocks_;
  LogToc described_toc_;
  std::vector<LogBlock> described_blocks_;  // by id, empty without a description
  std::uint32_t toc_revision_ = 0;
  bool toc_info_requested_ = false;
  DeviceClockUnwrapper clock_;
  std::optional<LogStamp> last_;     ///< of the packet read last
  std::optional<LogStamp> on_time_;  ///< of the last one that had not waited in the vehicle
  std::optional<LogStamp> leapt_;    ///< of the first one as late as all since, but not as the one before
  std::optional<LogStamp> doubted_;  ///< of the packet before, if its stamp was doubtful
  bool reset_received_ = false;
  std::uint32_t boot_ = 0;
  bool used_description_ = false;
  UnreadableRecords unreadable_;
};

}  // namespace swiftlet
