// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "firmware_link/session/log_session.hpp"

#include <algorithm>
#include <chrono>
#include <utility>

#include "core/base/check.hpp"
#include "firmware_link/crtp/byte_order.hpp"
#include "firmware_link/crtp/crtp_packet.hpp"

namespace swiftlet {
namespace {

// While the link is silent, packets of less than a second wait in the vehicle; older ones are discarded,
// except for eight in its radio.
constexpr Duration kClocksAgree = std::chrono::seconds(2);
// How late packets may have come before the vehicle discards those that wait: 200 of them and nine in its
// radio, of which the log blocks asked for here yield 21 a second.
constexpr Duration kLongestQueue = std::chrono::seconds(10);

/// How far the vehicle's clock has advanced from one packet to the other.
Duration device_step(const LogStamp& from, const LogStamp& to) {
  return std::chrono::milliseconds(
      DeviceClockUnwrapper::shortest_step_ms(std::int64_t{to.counter_ms} - from.counter_ms));
}

/// How much less than the host's clock.
Duration lateness(const LogStamp& from, const LogStamp& to) {
  using std::chrono::milliseconds;
  const auto host_ms = (to.received - from.received) / milliseconds(1);
  return milliseconds(
      DeviceClockUnwrapper::shortest_step_ms(host_ms - (std::int64_t{to.counter_ms} - from.counter_ms)));
}

/// Whether both can be of one clock: near each other, or as far apart as the packets were received.
bool are_of_one_clock(const LogStamp& a, const LogStamp& b) {
  return std::chrono::abs(device_step(a, b)) <= kClocksAgree ||
         std::chrono::abs(lateness(a, b)) <= kClocksAgree;
}

}  // namespace

void LogSession::describe(const BlockDescription& description) {
  described_blocks_.assign(256, LogBlock{});
  std::uint16_t variable = 0;
  for (const auto& [id, described] : description.blocks) {
    LogBlock& block = described_blocks_[id];
    block.exists = true;
    block.running = true;
    block.period = described.period;
    for (const BlockDescription::Variable& entry : described.variables) {
      described_toc_.add(variable, entry.type, entry.name);
      const bool fits = append_entry(block.entries, variable, entry.type);
      SWIFTLET_CHECK(fits, "a described block holds at most 26 bytes");
      ++variable;
    }
  }
}

std::optional<LogRecord> LogSession::on_frame(const LinkFrame& frame) {
  const std::span<const std::uint8_t> packet = frame.packet();
  if (frame.direction == LinkDirection::kToVehicle) {
    on_request(packet);
  } else if (is_on(packet, kLogDataTopic)) {
    return read(frame);
  } else if (is_on(packet, kLogTocTopic)) {
    on_toc_reply(packet);
  } else if (is_on(packet, kLogControlTopic)) {
    blocks_.on_reply(packet);
  }
  return std::nullopt;
}

/// What nobody asked for does not make it another vehicle.
void LogSession::on_toc_reply(std::span<const std::uint8_t> packet) {
  const std::optional<TocInfo> info = read_toc_info(packet);
  const bool was_asked = info && std::exchange(toc_info_requested_, false);
  if (info && toc_.info() && *info != *toc_.info() && !was_asked) return;
  if (toc_.on_reply(packet)) ++toc_revision_;
}

void LogSession::on_request(std::span<const std::uint8_t> packet) {
  const bool asks_for_toc_info = is_on(packet, kLogTocTopic) && packet.size() > 1 &&
                                 packet[1] == static_cast<std::uint8_t>(TocCommand::kInfo);
  toc_info_requested_ = toc_info_requested_ || asks_for_toc_info;
  if (!is_on(packet, kLogControlTopic)) return;
  blocks_.on_request(packet);
  if (packet.size() > 1 && packet[1] == static_cast<std::uint8_t>(LogCommand::kReset)) reset_received_ = true;
}

bool LogSession::continues(const LogStamp& stamp) const {
  return !last_ || are_of_one_clock(*last_, stamp) || are_of_one_clock(*on_time_, stamp);
}

/// The 24-bit clock of one packet cannot be distinguished from noise. A clock that has indeed restarted shows
/// in the next packet too.
bool LogSession::is_confirmed(const LogStamp& stamp) const {
  return doubted_ && doubted_->counter_ms != stamp.counter_ms && are_of_one_clock(*doubted_, stamp);
}

/// Follows how late packets are. True once they have been evenly late since a leap, for longer than anything
/// waits in the vehicle.
bool LogSession::host_clock_has_stepped(const LogStamp& stamp) {
  using std::chrono::abs;
  if (last_ && abs(lateness(*last_, stamp)) > kClocksAgree)
    leapt_ = stamp;
  else if (leapt_ &&
           (abs(lateness(*leapt_, stamp)) > kClocksAgree || abs(device_step(*last_, stamp)) > kClocksAgree))
    leapt_.reset();
  return leapt_ && device_step(*leapt_, stamp) > kLongestQueue;
}

/// A session begins with a reset, also after the link was lost. If the vehicle's clock did not advance as far
/// as the host's meanwhile, the vehicle has rebooted (or is another one). Where what waited was discarded, it
/// advances further.
std::optional<DeviceTime> LogSession::time_of(const LogStamp& stamp) {
  const bool is_after_reset = std::exchange(reset_received_, false);
  const bool is_of_the_clock = continues(stamp);
  if (!is_of_the_clock && !is_after_reset && !is_confirmed(stamp)) {
    doubted_ = stamp;
    return std::nullopt;
  }
  doubted_.reset();
  const bool host_has_stepped = host_clock_has_stepped(stamp);
  last_ = stamp;
  const Duration late = on_time_ ? lateness(*on_time_, stamp) : Duration::zero();
  const bool has_rebooted = is_after_reset && (late > kClocksAgree || late < -kLongestQueue);
  if (has_rebooted) {
    ++boot_;
    clock_ = {};
  }
  // The few packets that the vehicle's radio keeps through any silence do not show how the clocks compare.
  const bool has_waited = is_of_the_clock && late > kClocksAgree;
  if (!has_waited || has_rebooted || host_has_stepped) on_time_ = stamp;
  return clock_.unwrap(stamp.counter_ms);
}

std::optional<LogRecord> LogSession::read(const LinkFrame& frame) {
  const std::span<const std::uint8_t> packet = frame.packet();
  if (packet.size() < kLogDataPrefix) {
    ++unreadable_.misfit;
    return std::nullopt;
  }
  LogRecord record;
  record.block_id = packet[1];
  record.received = frame.at;
  record.values = packet.subspan(kLogDataPrefix);
  if (!find_layout(record)) return std::nullopt;
  const std::optional<DeviceTime> at =
      time_of({static_cast<std::uint32_t>(load_little_endian(packet, 2, 3)), frame.at});
  if (!at) {
    ++unreadable_.wrong_time;
    return std::nullopt;
  }
  record.at = *at;
  record.boot = boot_;
  return record;
}

bool LogSession::find_layout(LogRecord& record) {
  record.entry_count = blocks_.entries_in(record.block_id, record.values.size());
  record.block = &blocks_[record.block_id];
  if (is_named(*record.block, std::max<std::size_t>(record.entry_count, 1))) {
    if (record.entry_count > 0) return true;
    ++unreadable_.misfit;
    return false;
  }
  if (described_blocks_.empty() || !described_blocks_[record.block_id].exists) {
    ++unreadable_.unknown_block;
    return false;
  }
  record.block = &described_blocks_[record.block_id];
  if (byte_count(record.block->entries) != record.values.size()) {
    ++unreadable_.misfit;
    return false;
  }
  record.described = true;
  record.entry_count = record.block->entries.size();
  used_description_ = true;
  return true;
}

bool LogSession::is_named(const LogBlock& block, std::size_t entry_count) const {
  return block.entries.size() >= entry_count &&
         std::all_of(block.entries.begin(), block.entries.begin() + entry_count,
                     [this](const LogEntry& entry) { return toc_.has(entry.variable); });
}

std::string_view LogSession::name_of(const LogRecord& record, std::size_t entry) const {
  const LogToc& toc = record.described ? described_toc_ : toc_;
  return toc.name_of(record.block->entries[entry].variable);
}

}  // namespace swiftlet
