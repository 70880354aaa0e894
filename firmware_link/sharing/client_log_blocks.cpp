// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "firmware_link/sharing/client_log_blocks.hpp"

#include <algorithm>
#include <chrono>

#include "firmware_link/link/link_packet.hpp"

namespace swiftlet {
namespace {

constexpr Duration kRepeatAfter = std::chrono::milliseconds(200);
constexpr std::size_t kBytesPerEntry = 3;
constexpr std::size_t kBeforeEntries = 3;  // header, command, block

/// The vehicle answers a log command in the request's buffer.
CrtpPacket answer_to(std::span<const std::uint8_t> request, LogError error) {
  CrtpPacket answer;
  for (const std::uint8_t byte : {request[0], request[1], request.size() > 2 ? request[2] : std::uint8_t{0},
                                  static_cast<std::uint8_t>(error)})
    static_cast<void>(answer.try_push_back(byte));
  return answer;
}

CrtpPacket with_block(std::span<const std::uint8_t> packet, std::size_t at, std::uint8_t block) {
  CrtpPacket changed = packet_of(packet);
  changed[at] = block;
  return changed;
}

std::size_t entries_in(std::span<const std::uint8_t> request) {
  return (request.size() - kBeforeEntries) / kBytesPerEntry;
}

}  // namespace

ClientLogBlocks::Outcome ClientLogBlocks::on_request(std::span<const std::uint8_t> packet) {
  if (packet.size() < 2) return {};
  const auto command = static_cast<LogCommand>(packet[1]);
  if (command == LogCommand::kReset) {
    reset_ = packet_of(packet);
    for (Block& block : blocks_) block.is_doomed = true;
    return {};
  }
  if (packet.size() < kBeforeEntries) return {};
  const bool is_known = command >= LogCommand::kDelete && command <= LogCommand::kStartV2;
  if (!is_known) return {.request = {}, .answer = answer_to(packet, LogError::kUnknownCommand)};
  if (command == LogCommand::kCreate) return create(packet);
  Block* const block = find(packet[2]);
  if (block == nullptr) return {.request = {}, .answer = answer_to(packet, LogError::kUnknown)};
  if (command == LogCommand::kAppend) return append(packet, *block);
  return forward(packet, *block);
}

/// The vehicle keeps the variables before one that it refuses, so a refused request counts, too: up to what a
/// block can hold.
ClientLogBlocks::Outcome ClientLogBlocks::append(std::span<const std::uint8_t> packet, Block& block) {
  const std::size_t variables = std::min(block.variables + entries_in(packet), kMaxLogBytes);
  if (!has_room_for(variables - block.variables))
    return {.request = {}, .answer = answer_to(packet, LogError::kNoRoom)};
  block.variables = variables;
  return forward(packet, block);
}

/// That a block is there already, the vehicle answers itself.
ClientLogBlocks::Outcome ClientLogBlocks::create(std::span<const std::uint8_t> packet) {
  if (const Block* const known = find(packet[2])) return forward(packet, *known);
  if (blocks_.full() || !has_room_for(entries_in(packet)))
    return {.request = {}, .answer = answer_to(packet, LogError::kNoRoom)};
  static_cast<void>(blocks_.try_push_back(
      {.clients = packet[2], .vehicles = free_number(), .variables = entries_in(packet)}));
  return forward(packet, blocks_.back());
}

ClientLogBlocks::Outcome ClientLogBlocks::forward(std::span<const std::uint8_t> packet,
                                                  const Block& block) const {
  return {.request = with_block(packet, 2, block.vehicles), .answer = {}};
}

std::optional<CrtpPacket> ClientLogBlocks::on_answer(std::span<const std::uint8_t> packet) {
  if (packet.size() < 4) return std::nullopt;
  const auto block = std::ranges::find(blocks_, packet[2], &Block::vehicles);
  if (block == blocks_.end()) return std::nullopt;
  const CrtpPacket answer = with_block(packet, 2, block->clients);
  const bool was_asked = !block->is_doomed;
  const auto error = static_cast<LogError>(packet[3]);
  const bool is_gone = static_cast<LogCommand>(packet[1]) == LogCommand::kDelete &&
                       (error == LogError::kNone || error == LogError::kUnknown);
  if (is_gone) blocks_.erase(static_cast<std::size_t>(block - blocks_.begin()));
  if (!was_asked) return std::nullopt;
  return answer;
}

std::optional<CrtpPacket> ClientLogBlocks::on_data(std::span<const std::uint8_t> packet) const {
  if (packet.size() < 2) return std::nullopt;
  const auto block = std::ranges::find(blocks_, packet[1], &Block::vehicles);
  if (block == blocks_.end() || block->is_doomed) return std::nullopt;
  return with_block(packet, 1, block->clients);
}

std::optional<CrtpPacket> ClientLogBlocks::next_deletion(HostTime now) {
  for (Block& block : blocks_) {
    if (!block.is_doomed || now - kRepeatAfter < block.deletion_sent_at) continue;
    block.deletion_sent_at = now;
    return log_block_request(LogCommand::kDelete, block.vehicles);
  }
  return std::nullopt;
}

bool ClientLogBlocks::deletion_is_due(HostTime now) const {
  return std::ranges::any_of(blocks_, [now](const Block& block) {
    return block.is_doomed && now - kRepeatAfter >= block.deletion_sent_at;
  });
}

std::optional<CrtpPacket> ClientLogBlocks::take_reset_answer() {
  if (!reset_ || std::ranges::any_of(blocks_, &Block::is_doomed)) return std::nullopt;
  const CrtpPacket answer = answer_to(bytes_of(*reset_), LogError::kNone);
  reset_.reset();
  return answer;
}

void ClientLogBlocks::abandon() {
  reset_.reset();
  for (Block& block : blocks_) block.is_doomed = true;
}

bool ClientLogBlocks::forget_all() {
  const bool has_lost_one = !std::ranges::all_of(blocks_, &Block::is_doomed);
  blocks_.clear();
  return has_lost_one;
}

ClientLogBlocks::Block* ClientLogBlocks::find(std::uint8_t clients) {
  const auto found = std::ranges::find_if(
      blocks_, [clients](const Block& block) { return !block.is_doomed && block.clients == clients; });
  return found == blocks_.end() ? nullptr : found;
}

bool ClientLogBlocks::has_room_for(std::size_t variables) const {
  std::size_t used = 0;
  for (const Block& block : blocks_) used += block.variables;
  return used + variables <= kMaxVariables;
}

/// In turn: a late answer about a block that is gone must not be taken for one about its successor.
/// Precondition: there are fewer blocks than numbers.
std::uint8_t ClientLogBlocks::free_number() {
  const auto is_used = [this] {
    return std::ranges::find(blocks_, last_number_, &Block::vehicles) != blocks_.end();
  };
  do {
    last_number_ = has_number(last_number_ + 1) ? last_number_ + 1 : kFirstBlock;
  } while (is_used());
  return last_number_;
}

}  // namespace swiftlet
