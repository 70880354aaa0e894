// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "firmware_link/log_handshake.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <utility>

namespace swiftlet {
namespace {

constexpr Duration kRepeatAfter = std::chrono::milliseconds(200);
constexpr std::uint8_t kPeriod10ms = 10;
constexpr std::size_t kMostRemakes = 20;
constexpr std::string_view kSourceText = "Bitcraze Crazyflie";

// Everything of one instant in one packet: 26 bytes, the most a block can hold.
constexpr std::array<std::string_view, 10> kOneBlock{
    "stateEstimate.x", "stateEstimate.y", "stateEstimate.yaw", "range.front",     "range.back",
    "range.left",      "range.right",     "range.zrange",      "supervisor.info", "pm.vbatMV"};
// For firmware that lacks one of those.
constexpr std::array<std::string_view, 2> kPositionBlock{"stateEstimateZ.x", "stateEstimateZ.y"};
constexpr std::array<std::string_view, 3> kPositionBlockExtras{"stateEstimateZ.z", "pm.vbatMV", "radio.rssi"};
constexpr std::array<std::string_view, 8> kRangeBlock{
    "stateEstimate.qw", "stateEstimate.qx", "stateEstimate.qy", "stateEstimate.qz",
    "range.front",      "range.back",       "range.left",       "range.right"};
constexpr std::array<std::string_view, 1> kRangeBlockExtras{"range.zrange"};

}  // namespace

LogHandshake::LogHandshake(const LogSession& session) : session_(session) { enter(Step::kSource); }

std::optional<CrtpPacket> LogHandshake::next_request(HostTime now) {
  if (!request_) return std::nullopt;
  if (sent_at_ && now - *sent_at_ < kRepeatAfter) return std::nullopt;
  // An append must not reach the vehicle twice, and nobody knows whether the first did: make the block anew.
  if (sent_at_ && step_ == Step::kBlocks && !deleting_ &&
      (*request_)[1] == static_cast<std::uint8_t>(LogCommand::kAppend))
    remake_block();
  if (!request_) return std::nullopt;
  sent_at_ = now;
  return request_;
}

void LogHandshake::hear(std::span<const std::uint8_t> packet) {
  if (step_ == Step::kSource && is_on(packet, kLinkSourceTopic)) {
    const std::string_view text(reinterpret_cast<const char*>(packet.data()) + 1, packet.size() - 1);
    if (!text.starts_with(kSourceText))
      return fail("the vehicle is not a Crazyflie, or older than CRTP protocol 1");
    enter(Step::kVersion);
  } else if (step_ == Step::kVersion && is_on(packet, kPlatformVersionTopic)) {
    hear_version(packet);
  } else if ((step_ == Step::kTocInfo || step_ == Step::kTocItems) && is_on(packet, kLogTocTopic)) {
    hear_toc(packet);
  } else if ((step_ == Step::kReset || step_ == Step::kBlocks) && is_on(packet, kLogControlTopic)) {
    hear_control(packet);
  }
}

void LogHandshake::enter(Step step) {
  step_ = step;
  request_.reset();
  if (step == Step::kSource) request(source_request());
  if (step == Step::kVersion) request(protocol_version_request());
  if (step == Step::kReset) request(log_reset_request());
  if (step == Step::kTocInfo) request(toc_info_request());
}

void LogHandshake::request(const CrtpPacket& packet) {
  request_ = packet;
  sent_at_.reset();
}

void LogHandshake::fail(std::string message) {
  failure_ = Error{ErrorCode::kInvalidInput, std::move(message)};
  enter(Step::kFailed);
}

void LogHandshake::hear_version(std::span<const std::uint8_t> packet) {
  if (packet.size() < 3 || packet[1] != 0) return;
  const int version = packet[2];
  if (version < kOldestProtocol)
    return fail("the vehicle's firmware speaks CRTP protocol " + std::to_string(version) +
                ", swiftlet needs 4 or newer: update it to 2018.10 or newer");
  if (version > kNewestProtocol)
    notes_.push_back("the vehicle's firmware speaks CRTP protocol " + std::to_string(version) +
                     ", newer than 12, the newest known");
  enter(Step::kReset);
}

void LogHandshake::hear_toc(std::span<const std::uint8_t> packet) {
  if (packet.size() < 2) return;
  const auto command = static_cast<LogTocCommand>(packet[1]);
  if (step_ == Step::kTocInfo && command == LogTocCommand::kInfo && session_.toc().info()) {
    enter(Step::kTocItems);
    item_ = 0;
    ask_next_item();
  } else if (step_ == Step::kTocItems && command == LogTocCommand::kItem) {
    // A reply of two bytes says that there is no such item, although the table counts it.
    if (packet.size() == 2)
      return fail("the vehicle's table of contents ends at item " + std::to_string(item_) + " of " +
                  std::to_string(session_.toc().info()->count) + ": restart the vehicle");
    ask_next_item();
  }
}

void LogHandshake::ask_next_item() {
  while (item_ < session_.toc().info()->count && session_.toc().has(item_)) ++item_;
  if (item_ >= session_.toc().info()->count) return plan_blocks();
  const CrtpPacket wanted = toc_item_request(item_);
  // A reply to an earlier, repeated request changes nothing: the timer runs on.
  if (!request_ || !std::equal(wanted.begin(), wanted.end(), request_->begin(), request_->end()))
    request(wanted);
}

void LogHandshake::plan_blocks() {
  plan_.clear();
  if (!plan_block(1, kOneBlock, {})) {
    plan_.clear();
    if (!plan_block(1, kPositionBlock, kPositionBlockExtras) ||
        !plan_block(2, kRangeBlock, kRangeBlockExtras)) {
      std::string missing;
      for (const std::string_view name : kPositionBlock)
        if (!session_.toc().find(name)) missing += ' ' + std::string(name);
      for (const std::string_view name : kRangeBlock)
        if (!session_.toc().find(name)) missing += ' ' + std::string(name);
      return fail("the vehicle's firmware does not offer the log variables" + missing);
    }
  }
  step_ = Step::kBlocks;
  block_ = 0;
  block_request_ = 0;
  send_block_request();
}

bool LogHandshake::plan_block(std::uint8_t id, std::span<const std::string_view> required,
                              std::span<const std::string_view> optional) {
  PlannedBlock planned;
  planned.id = id;
  planned.requests.push_back(log_block_request(LogCommand::kCreate, id));
  for (const std::span<const std::string_view> names : {required, optional}) {
    for (const std::string_view name : names) {
      const std::optional<std::uint16_t> variable = session_.toc().find(name);
      if (!variable && names.data() == required.data()) return false;
      if (!variable) continue;
      const auto type = static_cast<std::uint8_t>(session_.toc().type_of(*variable));
      if (add_log_entry(planned.requests.back(), type, *variable)) continue;
      planned.requests.push_back(log_block_request(LogCommand::kAppend, id));
      static_cast<void>(add_log_entry(planned.requests.back(), type, *variable));
    }
  }
  planned.requests.push_back(log_start_request(id, kPeriod10ms));
  plan_.push_back(std::move(planned));
  return true;
}

void LogHandshake::hear_control(std::span<const std::uint8_t> packet) {
  if (packet.size() < 4 || !request_ || packet[1] != (*request_)[1]) return;
  const auto command = static_cast<LogCommand>(packet[1]);
  const auto error = static_cast<LogError>(packet[3]);
  if (step_ == Step::kReset) {
    // The id in the reply to a reset means nothing.
    if (error != LogError::kNone)
      return fail("the vehicle refuses to reset its log, error " + std::to_string(packet[3]));
    return enter(Step::kTocInfo);
  }
  if (packet[2] == plan_[block_].id) hear_block_reply(command, error);
}

void LogHandshake::hear_block_reply(LogCommand command, LogError error) {
  const bool done = error == LogError::kNone;
  if (command == LogCommand::kDelete && (done || error == LogError::kUnknown)) {
    deleting_ = false;
    block_request_ = 0;
    return send_block_request();
  }
  // It exists from a request whose reply was lost, or is gone with a reboot: make it anew.
  if ((command == LogCommand::kCreate && error == LogError::kExists) ||
      (command == LogCommand::kStart && error == LogError::kUnknown))
    return remake_block();
  if (!done)
    return fail("the vehicle refuses log block " + std::to_string(plan_[block_].id) + ", command " +
                std::to_string(static_cast<int>(command)) + ", error " +
                std::to_string(static_cast<int>(error)) +
                (error == LogError::kNoRoom ? ": its log is full; stop other clients" : ""));
  ++block_request_;
  if (block_request_ == plan_[block_].requests.size()) {
    ++block_;
    block_request_ = 0;
  }
  send_block_request();
}

void LogHandshake::send_block_request() {
  if (block_ == plan_.size()) return enter(Step::kFinished);
  request(plan_[block_].requests[block_request_]);
}

void LogHandshake::remake_block() {
  if (++remakes_ > kMostRemakes)
    return fail("log block " + std::to_string(plan_[block_].id) + " cannot be made in " +
                std::to_string(kMostRemakes) + " attempts: too many packets are lost");
  deleting_ = true;
  request(log_block_request(LogCommand::kDelete, plan_[block_].id));
}

}  // namespace swiftlet
