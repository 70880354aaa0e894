// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "firmware_link/simulation/params.hpp"

#include <algorithm>
#include <bit>
#include <string>

#include "firmware_link/crtp/byte_order.hpp"
#include "firmware_link/simulation/toc.hpp"

namespace swiftlet {
namespace {

// Headers that the firmware builds itself have link bits 0; other answers keep those of the request.
constexpr std::uint8_t kMiscHeader = 0x23;

enum Channel : std::uint8_t { kTable = 0, kRead = 1, kWrite = 2, kMisc = 3 };
enum MiscCommand : std::uint8_t {
  kSetByName = 0,
  kValueUpdated = 1,
  kGetExtendedType = 2,
  kStore = 3,
  kGetState = 4,
  kClearStored = 5,
  kGetDefault = 6,
  kGetExtendedTypeV2 = 7,
  kGetDefaultV2 = 8,
};
enum Errno : std::uint8_t { kOk = 0, kNoEntry = 2, kAccess = 13, kInvalid = 22 };
constexpr std::uint8_t kPersistentType = 1;  // the only extended type there is

bool exists(std::uint16_t id) { return id < simulated_param_table().size(); }
const ParamDescription& description(std::uint16_t id) { return simulated_param_table()[id]; }
bool has(std::uint16_t id, std::uint8_t flag) { return (description(id).flags & flag) != 0; }
std::size_t size_of(std::uint16_t id) { return param_type_size(description(id).type); }

std::uint64_t raw_of(double value, ParamType type) {
  if (type == ParamType::kFloat) return std::bit_cast<std::uint32_t>(static_cast<float>(value));
  if (type == ParamType::kDouble) return std::bit_cast<std::uint64_t>(value);
  const std::uint64_t bits = static_cast<std::uint64_t>(static_cast<std::int64_t>(value));
  const std::size_t unused = 64 - 8 * param_type_size(type);
  return bits << unused >> unused;
}

double number_of(std::uint64_t raw, ParamType type) {
  switch (type) {
    case ParamType::kInt8:
      return static_cast<std::int8_t>(raw);
    case ParamType::kInt16:
      return static_cast<std::int16_t>(raw);
    case ParamType::kInt32:
      return static_cast<std::int32_t>(raw);
    case ParamType::kInt64:
      return static_cast<double>(static_cast<std::int64_t>(raw));
    case ParamType::kFloat:
      return static_cast<double>(std::bit_cast<float>(static_cast<std::uint32_t>(raw)));
    case ParamType::kDouble:
      return std::bit_cast<double>(raw);
    default:
      return static_cast<double>(raw);
  }
}

std::uint64_t default_of(std::uint16_t id) {
  return raw_of(description(id).default_value, description(id).type);
}

}  // namespace

SimulatedParams::SimulatedParams() { boot(); }

void SimulatedParams::boot() {
  values_.resize(simulated_param_table().size());
  for (std::uint16_t id = 0; exists(id); ++id) {
    const auto stored = stored_.find(id);
    values_[id] = stored == stored_.end() ? default_of(id) : stored->second;
  }
}

double SimulatedParams::number(std::uint16_t id) const {
  return number_of(values_[id], description(id).type);
}

void SimulatedParams::set(std::uint16_t id, double value) {
  values_[id] = raw_of(value, description(id).type);
}

PacketBytes SimulatedParams::change(std::uint16_t id, double value) {
  set(id, value);
  PacketBytes notice;
  put(notice, kMiscHeader);
  put(notice, kValueUpdated);
  put_little_endian(notice, id, 2);
  put_little_endian(notice, values_[id], size_of(id));
  return notice;
}

std::optional<PacketBytes> SimulatedParams::handle(std::span<const std::uint8_t> packet) {
  switch (packet[0] & 0x03U) {
    case kTable:
      return answer_table(packet);
    case kRead:
      return read(packet);
    case kWrite:
      return write(packet);
    default:
      return answer_misc(packet);
  }
}

std::optional<PacketBytes> SimulatedParams::answer_table(std::span<const std::uint8_t> packet) const {
  if (asks_for_toc_info(packet))
    return simulated_toc_info(kParamTocTopic, values_.size(), simulated_param_table_crc());
  const std::optional<std::uint16_t> id = wanted_toc_item(packet);
  if (!id) return std::nullopt;  // recent firmware has no 8-bit commands any more
  if (!exists(*id)) return simulated_toc_end(kParamTocTopic);
  const ParamDescription& param = description(*id);
  const auto type = static_cast<std::uint8_t>(static_cast<unsigned>(param.type) | param.flags);
  return simulated_toc_item(kParamTocTopic, *id, type, param.group, param.name);
}

std::optional<PacketBytes> SimulatedParams::read(std::span<const std::uint8_t> packet) const {
  if (packet.size() < 3) return std::nullopt;
  const std::uint16_t id = load_u16(packet, 1);
  PacketBytes reply = head_of(packet, 3);
  put(reply, exists(id) ? kOk : kNoEntry);
  if (exists(id)) put_little_endian(reply, values_[id], size_of(id));
  return reply;
}

std::optional<PacketBytes> SimulatedParams::write(std::span<const std::uint8_t> packet) {
  if (packet.size() < 3) return std::nullopt;
  const std::uint16_t id = load_u16(packet, 1);
  if (!exists(id)) {
    PacketBytes reply = head_of(packet, 3);
    put(reply, kNoEntry);
    return reply;
  }
  if (has(id, kParamReadOnly) || packet.size() < 3 + size_of(id)) return std::nullopt;
  values_[id] = load_little_endian(packet, 3, size_of(id));
  return head_of(packet, packet.size());
}

std::optional<PacketBytes> SimulatedParams::answer_misc(std::span<const std::uint8_t> packet) {
  if (packet.size() < 4) return std::nullopt;
  if (packet[1] == kSetByName) return set_by_name(packet);
  const std::uint16_t id = load_u16(packet, 2);
  PacketBytes reply = head_of(packet, 4);
  const bool is_known = exists(id);
  const bool is_extended = is_known && has(id, kParamPersistent);
  const bool has_default = is_known && !has(id, kParamReadOnly);
  switch (packet[1]) {
    case kGetExtendedType:
      put(reply, is_extended ? kPersistentType : static_cast<std::uint8_t>(kNoEntry));
      return reply;
    case kGetExtendedTypeV2:
      put(reply, is_extended ? kOk : kNoEntry);
      if (is_extended) put(reply, kPersistentType);
      return reply;
    case kGetDefault:
    case kGetDefaultV2:
      if (packet[1] == kGetDefaultV2 || !has_default) put(reply, has_default ? kOk : kNoEntry);
      if (has_default) put_little_endian(reply, default_of(id), size_of(id));
      return reply;
    case kStore:
      put(reply, is_known ? kOk : kNoEntry);
      if (is_known) stored_[id] = values_[id];
      return reply;
    case kClearStored:
      put(reply, stored_.erase(id) > 0 ? kOk : kNoEntry);
      return reply;
    case kGetState:
      put_state(reply, id);
      return reply;
    default:
      return std::nullopt;
  }
}

/// Whether a value is stored, the default, and the stored value if there is one.
void SimulatedParams::put_state(PacketBytes& reply, std::uint16_t id) const {
  if (!exists(id)) return put(reply, kNoEntry);
  const auto stored = stored_.find(id);
  put(reply, stored != stored_.end() ? 1 : 0);
  put_little_endian(reply, default_of(id), size_of(id));
  if (stored != stored_.end()) put_little_endian(reply, stored->second, size_of(id));
}

std::optional<PacketBytes> SimulatedParams::set_by_name(std::span<const std::uint8_t> packet) {
  const auto group_end = std::find(packet.begin() + 2, packet.end(), 0);
  if (group_end == packet.end()) return std::nullopt;
  const auto name_end = std::find(group_end + 1, packet.end(), 0);
  if (name_end == packet.end()) return std::nullopt;
  const std::string group(packet.begin() + 2, group_end);
  const std::string name(group_end + 1, name_end);
  PacketBytes reply = head_of(packet, static_cast<std::size_t>(name_end + 1 - packet.begin()));
  if (reply.full()) return std::nullopt;  // no room for a value: no answer
  put(reply, write_by_name(group, name, packet.subspan(reply.size())));
  return reply;
}

std::uint8_t SimulatedParams::write_by_name(std::string_view group, std::string_view name,
                                            std::span<const std::uint8_t> type_and_value) {
  for (std::uint16_t id = 0; exists(id); ++id) {
    if (description(id).group != group || description(id).name != name) continue;
    const bool fits = type_and_value.size() >= 1 + size_of(id) &&
                      type_and_value[0] == static_cast<std::uint8_t>(description(id).type);
    if (!fits) return kInvalid;
    if (has(id, kParamReadOnly)) return kAccess;
    values_[id] = load_little_endian(type_and_value, 1, size_of(id));
    return kOk;
  }
  return kNoEntry;
}

}  // namespace swiftlet
