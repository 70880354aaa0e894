// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "firmware_link/session/log_block_table.hpp"

#include <chrono>
#include <optional>
#include <utility>

#include "firmware_link/crtp/byte_order.hpp"

namespace swiftlet {
namespace {

/// The entries of a create or append request. Stops at an invalid one, as the vehicle does.
LogEntries parse_entries(std::span<const std::uint8_t> packet) {
  LogEntries entries;
  for (std::size_t at = 3; at + 3 <= packet.size(); at += 3) {
    const std::optional<LogType> type = log_type_of(packet[at]);
    if (!type || !append_entry(entries, load_u16(packet, at + 1), *type)) break;
  }
  return entries;
}

/// As many of `added` as fit.
void append_all(LogEntries& entries, const LogEntries& added) {
  for (const LogEntry& entry : added)
    if (!append_entry(entries, entry.variable, entry.type)) return;
}

}  // namespace

bool append_entry(LogEntries& entries, std::uint16_t variable, LogType type) {
  const std::size_t offset = byte_count(entries);
  if (offset + size_of(type) > kMaxLogBytes) return false;
  return entries.try_push_back({variable, type, static_cast<std::uint8_t>(offset)});
}

std::size_t byte_count(const LogEntries& entries) {
  return entries.empty() ? 0 : entries.back().offset + size_of(entries.back().type);
}

void LogBlockTable::on_request(std::span<const std::uint8_t> packet) {
  if (packet.size() < 2) return;
  const auto command = static_cast<LogCommand>(packet[1]);
  if (command == LogCommand::kReset) reset_requested_ = true;
  if (packet.size() < 3) return;
  Request& request = requests_[packet[2]];
  if (command == LogCommand::kCreate || command == LogCommand::kAppend) {
    request.command = command;
    request.answered = false;
    request.entries = parse_entries(packet);
  } else if (command == LogCommand::kStart && packet.size() >= 4) {
    request.period = std::chrono::milliseconds(10 * packet[3]);
  } else if (command == LogCommand::kStartV2 && packet.size() >= 5) {
    request.period = std::chrono::milliseconds(load_u16(packet, 3));
  }
}

void LogBlockTable::on_reply(std::span<const std::uint8_t> packet) {
  if (packet.size() < 4) return;
  const auto command = static_cast<LogCommand>(packet[1]);
  const std::uint8_t id = packet[2];
  const auto error = static_cast<LogError>(packet[3]);
  const bool done = error == LogError::kNone;
  switch (command) {
    case LogCommand::kCreate:
      apply_create(id, error);
      break;
    case LogCommand::kAppend:
      apply_append(id, error);
      break;
    case LogCommand::kStart:
    case LogCommand::kStartV2:
      if (done) {
        blocks_[id].running = true;
        blocks_[id].period = requests_[id].period;
      }
      break;
    case LogCommand::kStop:
      if (done) blocks_[id].running = false;
      break;
    case LogCommand::kDelete:
      if (done) forget(id);
      break;
    case LogCommand::kReset:
      // Nobody asked for it: damaged, late, or for another program, whose reset ends the log data.
      if (done && std::exchange(reset_requested_, false)) forget_all();
      break;
  }
  const bool names_block = command == LogCommand::kStart || command == LogCommand::kStartV2 ||
                           command == LogCommand::kStop || command == LogCommand::kDelete;
  if (names_block && error == LogError::kUnknown) forget(id);
  ++revision_;
}

void LogBlockTable::apply_create(std::uint8_t id, LogError error) {
  Request& request = requests_[id];
  LogBlock& block = blocks_[id];
  if (request.command != LogCommand::kCreate || request.answered) return;
  request.answered = true;
  if (error == LogError::kExists && block.exists) return;  // its contents have not changed
  const bool in_part =
      error == LogError::kUnknown || error == LogError::kTooBig || error == LogError::kNoRoom;
  if (error != LogError::kNone && error != LogError::kExists && !in_part) return;
  block = {};
  block.exists = true;
  // An existing block whose creation was not received is most likely this one, its first reply lost.
  block.uncertain = error != LogError::kNone;
  block.entries = request.entries;
}

void LogBlockTable::apply_append(std::uint8_t id, LogError error) {
  Request& request = requests_[id];
  LogBlock& block = blocks_[id];
  if (request.command != LogCommand::kAppend || !block.exists) return;
  const bool again = request.answered;
  request.answered = true;
  if (error == LogError::kUnknownCommand) return;
  // A second reply is either a repeat of the first or a second execution: only the size shows which.
  block.uncertain = block.uncertain || error != LogError::kNone || again;
  append_all(block.entries, request.entries);
}

void LogBlockTable::forget(std::uint8_t id) {
  blocks_[id] = {};
  // A create that waits for its reply was sent after the request that is answered here, the reply to which
  // was late: the vehicle answers in order.
  Request& request = requests_[id];
  if (request.command != LogCommand::kCreate || request.answered) request = {};
}

void LogBlockTable::forget_all() {
  blocks_.fill({});
  requests_.fill({});
}

std::size_t LogBlockTable::entries_in(std::uint8_t id, std::size_t value_bytes) {
  LogBlock& block = blocks_[id];
  if (block.exists && byte_count(block.entries) == value_bytes) return block.entries.size();

  Request& request = requests_[id];
  const bool unanswered = !request.answered && !request.entries.empty();
  if (unanswered && (request.command == LogCommand::kCreate) != block.exists) {
    LogEntries supposed = block.entries;
    append_all(supposed, request.entries);
    if (byte_count(supposed) == value_bytes) {
      block.exists = true;
      block.entries = supposed;
      request.answered = true;
      ++revision_;
      return supposed.size();
    }
  }
  if (!block.uncertain) return 0;
  for (std::size_t i = 0; i < block.entries.size(); ++i)
    if (block.entries[i].offset + size_of(block.entries[i].type) == value_bytes) return i + 1;
  return 0;
}

}  // namespace swiftlet
