// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "firmware_link/sample_table/client_table_link.hpp"

#include <algorithm>
#include <bit>
#include <initializer_list>
#include <limits>
#include <optional>
#include <string_view>

#include "firmware_link/crtp/byte_order.hpp"
#include "firmware_link/crtp/crtp_packet.hpp"
#include "firmware_link/crtp/log_value.hpp"
#include "firmware_link/sample_table/table_fields.hpp"

namespace swiftlet {
namespace {

constexpr std::string_view kTimeColumn = "Timestamp";
constexpr std::size_t kValueBytes = 4;

/// nullopt: the line names no variables, or more than a log block holds.
std::optional<std::vector<std::string>> variables_in(std::string_view head) {
  if (next_field(head, ',') != kTimeColumn) return std::nullopt;
  std::vector<std::string> variables;
  while (!head.empty()) variables.emplace_back(next_field(head, ','));
  const bool is_block = !variables.empty() && variables.size() <= kMaxLogBytes;
  return is_block ? std::optional(std::move(variables)) : std::nullopt;
}

/// A packed quaternion has bits that a float would round away.
LogType type_of(std::string_view variable) {
  return variable.ends_with(".quat") ? LogType::kUint32 : LogType::kFloat;
}

void append_bytes(LinkFrame& frame, std::uint32_t bits, std::size_t bytes) {
  for (std::size_t i = 0; i < bytes; ++i)
    frame.bytes[frame.size++] = static_cast<std::uint8_t>((bits >> (8 * i)) & 0xFF);
}

std::uint32_t bits_of(double value, LogType type) {
  if (type == LogType::kFloat) return std::bit_cast<std::uint32_t>(static_cast<float>(value));
  const bool fits = value >= 0.0 && value <= std::numeric_limits<std::uint32_t>::max();
  return fits ? static_cast<std::uint32_t>(value) : 0;
}

std::string_view prefix_of(std::string_view variable) { return variable.substr(0, variable.find('.')); }

/// What is of use only together goes into one block, where a prefix needs several.
std::string_view quantity_of(std::string_view variable) {
  const std::string_view name = variable.substr(prefix_of(variable).size());
  const auto is_one_of = [name](std::initializer_list<std::string_view> names) {
    return std::ranges::find(names, name) != names.end();
  };
  if (is_one_of({".x", ".y", ".z", ".stateX", ".stateY", ".stateZ"})) return " position";
  if (is_one_of({".qx", ".qy", ".qz", ".qw", ".q0", ".q1", ".q2", ".q3"})) return " quaternion";
  if (is_one_of({".roll", ".pitch", ".yaw"})) return " angles";
  if (is_one_of({".front", ".back", ".left", ".right"})) return " ranges";
  return " other";
}

}  // namespace

bool is_client_table(const std::string& path) {
  Result<GzipLines> lines = GzipLines::open(path);
  if (!lines) return false;
  const Result<std::string_view> first = lines->next();
  return first && variables_in(*first);
}

Result<std::unique_ptr<ClientTableLink>> ClientTableLink::open(const std::string& path) {
  Result<GzipLines> lines = GzipLines::open(path);
  if (!lines) return lines.error();
  std::unique_ptr<ClientTableLink> link(new ClientTableLink(path, std::move(lines).value()));
  const Result<std::string_view> head = link->lines_.next();
  if (!head) return head.error();
  const auto variables = variables_in(*head).value_or(std::vector<std::string>());
  for (const std::string& variable : variables) link->describe(variable, variables);
  return link;
}

void ClientTableLink::describe(const std::string& variable, std::span<const std::string> all) {
  const std::string_view prefix = prefix_of(variable);
  const auto alike = [&](const std::string& other) { return prefix_of(other) == prefix; };
  std::string group(prefix);
  if (std::ranges::count_if(all, alike) > static_cast<std::ptrdiff_t>(kMaxLogBytes / kValueBytes))
    group += quantity_of(variable);
  std::uint8_t block = 0;
  const auto has_room = [&] {
    return description_.blocks[block].variables.size() < kMaxLogBytes / kValueBytes;
  };
  while (block < group_of_block_.size() && !(group_of_block_[block] == group && has_room())) ++block;
  if (block == group_of_block_.size()) group_of_block_.push_back(group);
  description_.blocks[block].variables.push_back({variable, type_of(variable)});
  block_of_column_.push_back(block);
}

Result<LinkFrame> ClientTableLink::receive(Duration /*timeout*/) {
  while (next_ == frames_.size())
    if (const Status read = read_row(); !read) return read.error();
  return frames_[next_++];
}

Status ClientTableLink::read_row() {
  const Result<std::string_view> line = lines_.next();
  if (!line) return line.error();
  if (line->empty()) return {};
  std::string_view rest = *line;
  const auto time_ms = parse_number<std::uint64_t>(next_field(rest, ','));
  bool is_row = time_ms.has_value();
  begin_frames(static_cast<std::uint32_t>(time_ms.value_or(0) & 0xFFFFFF));
  for (const std::uint8_t block : block_of_column_) {
    const std::size_t index = (frames_[block].size - kLogDataPrefix) / kValueBytes;
    const LogType type = description_.blocks[block].variables[index].type;
    const auto value = parse_number<double>(next_field(rest, ','));
    is_row = is_row && value;
    append_bytes(frames_[block], bits_of(value.value_or(0.0), type), kValueBytes);
  }
  if (is_row && rest.empty()) return {};
  frames_.clear();
  return Error{ErrorCode::kDamaged, path_ + ", line " + std::to_string(lines_.line_number()) +
                                        ": is no row of a log block; the table is used up to there"};
}

void ClientTableLink::begin_frames(std::uint32_t counter_ms) {
  next_ = 0;
  LinkFrame frame;
  frame.at = HostTime(clock_.unwrap(counter_ms).time_since_epoch());
  frame.bytes[frame.size++] = crtp_header(kLogDataTopic);
  frames_.assign(group_of_block_.size(), frame);
  for (std::size_t block = 0; block < frames_.size(); ++block) {
    append_bytes(frames_[block], static_cast<std::uint32_t>(block), 1);
    append_bytes(frames_[block], counter_ms, 3);
  }
}

}  // namespace swiftlet
