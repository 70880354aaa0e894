// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "firmware_link/capture/session_preamble.hpp"

#include <chrono>
#include <cstdint>
#include <optional>
#include <set>
#include <string>
#include <utility>

#include "firmware_link/crtp/crtp_packet.hpp"
#include "firmware_link/crtp/toc_item.hpp"
#include "firmware_link/link/link_packet.hpp"
#include "firmware_link/session/log_block_table.hpp"
#include "firmware_link/session/log_toc.hpp"

namespace swiftlet {
namespace {

/// Collects the frames of the exchanges in order.
class Exchanges {
 public:
  explicit Exchanges(HostTime at) : at_(at) {}

  void add(const CrtpPacket& request, const CrtpPacket& reply) {
    frames_.push_back(frame_of(LinkDirection::kToVehicle, at_, bytes_of(request)));
    frames_.push_back(frame_of(LinkDirection::kFromVehicle, at_, bytes_of(reply)));
  }
  /// A command of the log's control channel with its usual reply.
  void add_control(const CrtpPacket& request, LogError error) {
    add(request,
        make_crtp_packet(kLogControlTopic, {request[1], request[2], static_cast<std::uint8_t>(error)}));
  }
  std::vector<LinkFrame> take() { return std::move(frames_); }

 private:
  HostTime at_;
  std::vector<LinkFrame> frames_;
};

void add_toc_info(const TocInfo& info, Exchanges& exchanges) {
  const auto crc_byte = [&info](int shift) { return low_byte(info.crc >> shift); };
  exchanges.add(
      toc_info_request(kLogTocTopic),
      make_crtp_packet(kLogTocTopic, {static_cast<std::uint8_t>(TocCommand::kInfo), low_byte(info.count),
                                      high_byte(info.count), crc_byte(0), crc_byte(8), crc_byte(16),
                                      crc_byte(24), kMaxLogBlocks, kMaxLogVariables}));
}

void add_toc_item(const LogToc& toc, std::uint16_t id, Exchanges& exchanges) {
  const std::optional<CrtpPacket> reply = toc_item_reply(
      kLogTocTopic, {id, static_cast<std::uint8_t>(toc.type_of(id)), std::string(toc.name_of(id))});
  // It was received in one packet, so it fits into one.
  if (reply) exchanges.add(toc_item_request(kLogTocTopic, id), *reply);
}

void add_start(std::uint8_t id, Duration period, Exchanges& exchanges) {
  const auto milliseconds = static_cast<unsigned>(period / std::chrono::milliseconds(1));
  const unsigned tens = milliseconds / 10;
  if (milliseconds % 10 == 0 && tens <= 0xFF) {
    exchanges.add_control(log_start_request(id, low_byte(tens)), LogError::kNone);
    return;
  }
  CrtpPacket request = log_block_request(LogCommand::kStartV2, id);
  static_cast<void>(request.try_push_back(low_byte(milliseconds)));
  static_cast<void>(request.try_push_back(high_byte(milliseconds)));
  exchanges.add_control(request, LogError::kNone);
}

void add_block(std::uint8_t id, const LogBlock& block, Exchanges& exchanges) {
  // A reader that knows an older layout must not append to it.
  exchanges.add_control(log_block_request(LogCommand::kDelete, id), LogError::kNone);
  // A reader takes a block for uncertain that exists but whose creation it has not received.
  LogError error = block.uncertain ? LogError::kExists : LogError::kNone;
  CrtpPacket request = log_block_request(LogCommand::kCreate, id);
  for (const LogEntry& entry : block.entries) {
    const auto type = static_cast<std::uint8_t>(entry.type);
    if (add_log_entry(request, type, entry.variable)) continue;
    exchanges.add_control(request, error);
    error = LogError::kNone;
    request = log_block_request(LogCommand::kAppend, id);
    static_cast<void>(add_log_entry(request, type, entry.variable));
  }
  exchanges.add_control(request, error);
  if (block.running) add_start(id, block.period, exchanges);
}

std::set<std::uint16_t> variables_in_use(const LogBlockTable& blocks) {
  std::set<std::uint16_t> variables;
  for (unsigned id = 0; id <= 0xFF; ++id)
    for (const LogEntry& entry : blocks[low_byte(id)].entries) variables.insert(entry.variable);
  return variables;
}

}  // namespace

std::vector<LinkFrame> session_preamble(const LogSession& session, HostTime at) {
  Exchanges exchanges(at);
  if (session.toc().info()) add_toc_info(*session.toc().info(), exchanges);
  for (const std::uint16_t variable : variables_in_use(session.blocks()))
    if (session.toc().has(variable)) add_toc_item(session.toc(), variable, exchanges);
  for (unsigned id = 0; id <= 0xFF; ++id)
    if (const LogBlock& block = session.blocks()[low_byte(id)]; block.exists)
      add_block(low_byte(id), block, exchanges);
  return exchanges.take();
}

}  // namespace swiftlet
