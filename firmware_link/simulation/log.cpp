// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "firmware_link/simulation/log.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <string>

#include "firmware_link/crtp/byte_order.hpp"
#include "firmware_link/simulation/toc.hpp"

namespace swiftlet {
namespace {

constexpr std::size_t kEntryBytes = 3;  // type, id of the variable

constexpr std::uint8_t kDataHeader = 0x52;

/// IEEE 754 half precision, rounded to nearest, ties to even.
std::uint16_t half_bits(float value) {
  const auto bits = std::bit_cast<std::uint32_t>(value);
  const auto sign = static_cast<std::uint16_t>(bits >> 16U & 0x8000U);
  const double magnitude = std::abs(static_cast<double>(value));
  if (std::isnan(value)) return sign | 0x7E00U;
  if (magnitude >= 65520.0) return sign | 0x7C00U;
  if (magnitude < 0x1p-14) return sign | static_cast<std::uint16_t>(std::nearbyint(magnitude * 0x1p24));
  int exponent = 0;
  const double fraction = std::frexp(magnitude, &exponent);                             // in [0.5, 1)
  const auto mantissa = static_cast<std::uint32_t>(std::nearbyint(fraction * 2048.0));  // 1024..2048
  return static_cast<std::uint16_t>(sign | ((static_cast<std::uint32_t>(exponent + 13) << 10U) + mantissa));
}

/// The value as stored in a variable of that type, and read back when it is logged.
double stored(double value, LogType type) {
  return type == LogType::kFloat ? static_cast<double>(static_cast<float>(value)) : std::trunc(value);
}

void put_value(PacketBytes& packet, double value, LogType fetch_type) {
  switch (fetch_type) {
    case LogType::kFloat:
      put_little_endian(packet, std::bit_cast<std::uint32_t>(static_cast<float>(value)), 4);
      break;
    case LogType::kHalf:
      put_little_endian(packet, half_bits(static_cast<float>(value)), 2);
      break;
    default:
      put_little_endian(packet, static_cast<std::uint64_t>(static_cast<std::int64_t>(value)),
                        log_type_size(fetch_type));
  }
}

PacketBytes table_info() {
  PacketBytes reply =
      simulated_toc_info(kLogTocTopic, simulated_log_table().size(), simulated_log_table_crc());
  put(reply, kMaxLogBlocks);
  put(reply, kMaxLogVariables);
  return reply;
}

std::optional<PacketBytes> answer_table(std::span<const std::uint8_t> packet) {
  if (asks_for_toc_info(packet)) return table_info();
  const std::optional<std::uint16_t> id = wanted_toc_item(packet);
  if (!id) return std::nullopt;  // protocol version 12 has no 8-bit commands any more
  if (*id >= simulated_log_table().size()) return simulated_toc_end(kLogTocTopic);
  const LogVariable& variable = simulated_log_table()[*id];
  return simulated_toc_item(kLogTocTopic, *id, static_cast<std::uint8_t>(variable.type), variable.group,
                            variable.name);
}

}  // namespace

bool SimulatedLog::has_running_block() const {
  for (const auto& [id, block] : blocks_)
    if (block.period.count() > 0) return true;
  return false;
}

std::optional<PacketBytes> SimulatedLog::handle(std::span<const std::uint8_t> packet, Milliseconds now) {
  const unsigned channel = packet[0] & 0x03U;
  if (channel == 0) return answer_table(packet);
  if (channel != 1 || packet.size() < 2) return std::nullopt;
  PacketBytes reply;
  put(reply, packet[0]);  // the firmware answers in the request's buffer, link bits included
  put(reply, packet[1]);
  put(reply, packet.size() > 2 ? packet[2] : std::uint8_t{0});
  put(reply, static_cast<std::uint8_t>(control(packet, now)));
  return reply;
}

LogError SimulatedLog::control(std::span<const std::uint8_t> packet, Milliseconds now) {
  const auto command = static_cast<LogCommand>(packet[1]);
  if (command == LogCommand::kReset) {
    clear();
    return LogError::kNone;
  }
  const bool is_known = command >= LogCommand::kDelete && command <= LogCommand::kStartV2;
  const std::size_t needed = command == LogCommand::kStart ? 4 : command == LogCommand::kStartV2 ? 5 : 3;
  if (!is_known || packet.size() < needed) return LogError::kUnknownCommand;
  const std::uint8_t id = packet[2];
  switch (command) {
    case LogCommand::kDelete:
      return blocks_.erase(id) > 0 ? LogError::kNone : LogError::kUnknown;
    case LogCommand::kStart:
      return start(id, Milliseconds(10 * packet[3]), now);
    case LogCommand::kStop:
      return stop(id);
    case LogCommand::kCreate:
      return create(id, packet.subspan(3));
    case LogCommand::kAppend:
      return append(id, packet.subspan(3));
    default:
      return start(id, Milliseconds(load_u16(packet, 3)), now);
  }
}

LogError SimulatedLog::create(std::uint8_t id, std::span<const std::uint8_t> entries) {
  if (blocks_.contains(id)) return LogError::kExists;
  if (blocks_.size() == kMaxLogBlocks) return LogError::kNoRoom;
  blocks_.emplace(id, Block{.entries = {}, .jitter = NoiseSource(seed_, "log_jitter/" + std::to_string(id))});
  return append(id, entries);
}

/// Not atomic, like the firmware's: entries before the one that fails stay in the block.
LogError SimulatedLog::append(std::uint8_t id, std::span<const std::uint8_t> entries) {
  const auto found = blocks_.find(id);
  if (found == blocks_.end()) return LogError::kUnknown;
  std::vector<Entry>& present = found->second.entries;
  for (; entries.size() >= kEntryBytes; entries = entries.subspan(kEntryBytes)) {
    const Entry entry{static_cast<LogType>(entries[0] & 0x0FU), load_u16(entries, 1)};
    std::size_t bytes = log_type_size(entry.fetch_type);
    for (const Entry& other : present) bytes += log_type_size(other.fetch_type);
    if (bytes > kMaxLogBytes) return LogError::kTooBig;
    if (entries_in_use() == kMaxLogVariables) return LogError::kNoRoom;
    const bool is_known =
        entry.variable < simulated_log_table().size() && log_type_size(entry.fetch_type) > 0;
    if (!is_known) return LogError::kUnknown;
    present.push_back(entry);
  }
  return LogError::kNone;
}

LogError SimulatedLog::start(std::uint8_t id, Milliseconds period, Milliseconds now) {
  const auto found = blocks_.find(id);
  if (found == blocks_.end()) return LogError::kUnknown;
  Block& block = found->second;
  if (period.count() == 0) {
    block.one_shot_due = true;
    return LogError::kNone;
  }
  block.period = period;
  block.beat = now + period;  // the first packet comes one period after the start
  block.schedule_after(now);
  return LogError::kNone;
}

LogError SimulatedLog::stop(std::uint8_t id) {
  const auto found = blocks_.find(id);
  if (found == blocks_.end()) return LogError::kUnknown;
  found->second.period = Milliseconds(0);
  return LogError::kNone;
}

void SimulatedLog::Block::schedule_after(Milliseconds now) {
  const Milliseconds late(std::lround(jitter.uniform(-1.49, 1.49)));
  due = std::max(beat + late, now + Milliseconds(1));
}

std::vector<PacketBytes> SimulatedLog::sample(Milliseconds now, const VehicleState& state) {
  std::vector<PacketBytes> packets;
  for (auto& [id, block] : blocks_) {
    const bool beat_is_due = block.period.count() > 0 && now >= block.due;
    if (!beat_is_due && !block.one_shot_due) continue;
    packets.push_back(data_packet(id, block, now, state));
    block.one_shot_due = false;
    if (!beat_is_due) continue;
    block.beat += block.period;
    block.schedule_after(now);
  }
  return packets;
}

PacketBytes SimulatedLog::data_packet(std::uint8_t id, const Block& block, Milliseconds now,
                                      const VehicleState& state) {
  PacketBytes packet;
  put(packet, kDataHeader);
  put(packet, id);
  put_little_endian(packet, static_cast<std::uint64_t>(now.count()), 3);
  for (const Entry& entry : block.entries) {
    const LogVariable& variable = simulated_log_table()[entry.variable];
    put_value(packet, stored(variable.read(state), variable.type), entry.fetch_type);
  }
  return packet;
}

std::size_t SimulatedLog::entries_in_use() const {
  std::size_t count = 0;
  for (const auto& [id, block] : blocks_) count += block.entries.size();
  return count;
}

}  // namespace swiftlet
