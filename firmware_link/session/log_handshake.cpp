// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "firmware_link/session/log_handshake.hpp"

#include <algorithm>
#include <array>
#include <utility>

namespace swiftlet {
namespace {

constexpr std::uint8_t kFast10ms = 10;
constexpr std::uint8_t kSlow10ms = 100;
// The longest wait for the reply to an append, in usual waits.
constexpr int kMaxPatience = 20;
// A damaged packet, or one for another program, may look like a refusal.
constexpr int kMaxAsksAgain = 3;
constexpr std::string_view kSourceText = "Bitcraze Crazyflie";

// All values of one instant in one packet: 26 bytes, the most that a block can hold.
constexpr std::array<std::string_view, 10> kOneBlock{
    "stateEstimate.x", "stateEstimate.y", "stateEstimate.yaw", "range.front",     "range.back",
    "range.left",      "range.right",     "range.zrange",      "supervisor.info", "pm.vbatMV"};
// For firmware that lacks one of those.
constexpr std::array<std::string_view, 2> kPositionBlock{"stateEstimateZ.x", "stateEstimateZ.y"};
// The vehicle's health as in kOneBlock, also by the names of other firmware releases.
constexpr std::array<std::string_view, 7> kPositionBlockExtras{
    "stateEstimateZ.z", "pm.vbatMV", "pm.vbat", "radio.rssi", "supervisor.info", "sys.isFlying", "baro.asl"};
constexpr std::array<std::string_view, 8> kRangeBlock{
    "stateEstimate.qw", "stateEstimate.qx", "stateEstimate.qy", "stateEstimate.qz",
    "range.front",      "range.back",       "range.left",       "range.right"};
constexpr std::array<std::string_view, 1> kRangeBlockExtras{"range.zrange"};
// Beside kOneBlock: the tilt that ranges are levelled by, and what tells storeys.
constexpr std::array<std::string_view, 2> kTiltBlock{"stateEstimate.roll", "stateEstimate.pitch"};
constexpr std::array<std::string_view, 1> kTiltBlockExtras{"baro.asl"};
// The vehicle's health, for the status and for readers of the recording.
constexpr std::array<std::string_view, 6> kSlowBlock{"pm.state",        "radio.rssi",  "range.up",
                                                     "stateEstimate.z", "kalman.varX", "kalman.varY"};
constexpr std::uint8_t kSlowBlockId = 3;
static_assert(kSlowBlockId <= kMaxOwnLogBlocks);
static_assert(kPositionBlock.size() + kPositionBlockExtras.size() + kRangeBlock.size() +
                  kRangeBlockExtras.size() + kSlowBlock.size() <=
              kMaxOwnLogVariables);

/// A variable of a known type; one of an unknown type could not be read.
const TocItem* find_readable(const TocDownload& toc, std::string_view name) {
  const TocItem* const item = toc.find(name);
  return item != nullptr && log_type_of(item->type) ? item : nullptr;
}

bool is_append(const CrtpPacket& control_request) {
  return control_request[1] == static_cast<std::uint8_t>(LogCommand::kAppend);
}

}  // namespace

LogHandshake::LogHandshake(const LogSession& session, TocCache& cache) : session_(&session), cache_(&cache) {
  enter(Step::kSource);
}

std::optional<CrtpPacket> LogHandshake::next_request(HostTime now) {
  if (step_ == Step::kToc) return toc_->next_request(now);
  if (!request_.is_due(now)) return std::nullopt;
  // An append must not reach the vehicle twice, and it is unknown whether the first did: remake the block.
  if (request_.was_sent() && step_ == Step::kBlocks && is_append(*request_.packet())) {
    append_patience_ = std::min(append_patience_ + 1, kMaxPatience);
    remake_block();
  }
  awaits_source_ = step_ == Step::kSource;
  return request_.take_due(now);
}

void LogHandshake::on_frame(std::span<const std::uint8_t> packet, HostTime at) {
  request_.on_frame(packet, at);
  if (step_ == Step::kSource && is_on(packet, kLinkSourceTopic)) return on_source(packet);
  if (step_ == Step::kVersion && is_on(packet, kPlatformVersionTopic)) return on_version(packet);
  if (step_ == Step::kToc && is_on(packet, kLogTocTopic)) return on_toc(packet, at);
  if (!is_on(packet, kLogControlTopic) || packet.size() < 4) return;
  if (!request_.packet() || packet[1] != (*request_.packet())[1]) return;
  if (step_ == Step::kReset) return on_reset(packet);
  if (step_ == Step::kBlocks) return on_block_reply(packet);
}

void LogHandshake::enter(Step step) {
  step_ = step;
  request_.drop();
  if (step == Step::kSource) request_.ask(source_request());
  if (step == Step::kVersion) request_.ask(version_request(VersionQuery::kProtocol));
  if (step == Step::kReset) request_.ask(log_reset_request());
  if (step == Step::kToc) toc_.emplace(kLogTocTopic, *cache_, request_.timer());
}

/// A vehicle that refuses gives the same answer each time; damage and garbage differ.
void LogHandshake::refuse(std::string message, std::span<const std::uint8_t> answer) {
  std::string refusal = message;
  refusal.append(answer.begin(), answer.end());
  if (refusal != refusal_) asks_again_ = 0;
  refusal_ = std::move(refusal);
  if (asks_again_ == kMaxAsksAgain) return fail({ErrorCode::kInvalidInput, std::move(message)});
  ++asks_again_;
  if (step_ != Step::kSource) enter(Step::kSource);
}

void LogHandshake::fail(Error why) {
  failure_ = std::move(why);
  enter(Step::kFailed);
}

void LogHandshake::on_source(std::span<const std::uint8_t> packet) {
  const std::string_view text(reinterpret_cast<const char*>(packet.data()) + 1, packet.size() - 1);
  if (text.starts_with(kSourceText)) return enter(Step::kVersion);
  // The right answer to the same request may still come.
  if (std::exchange(awaits_source_, false))
    refuse("the vehicle is not a Crazyflie, or older than CRTP protocol 1: check the address, or update it",
           packet);
}

void LogHandshake::on_version(std::span<const std::uint8_t> packet) {
  if (packet.size() < 3 || packet[1] != static_cast<std::uint8_t>(VersionQuery::kProtocol)) return;
  protocol_ = packet[2];
  if (protocol_ < kOldestProtocol)
    return refuse("the vehicle's firmware has CRTP protocol " + std::to_string(protocol_) +
                      ", swiftlet needs 4 or newer: update it to 2018.10 or newer",
                  packet);
  enter(Step::kReset);
}

void LogHandshake::on_reset(std::span<const std::uint8_t> packet) {
  // The id in the reply to a reset has no meaning.
  if (static_cast<LogError>(packet[3]) != LogError::kNone)
    return refuse("the vehicle refuses to reset its log, error " + std::to_string(packet[3]) +
                  ": restart the vehicle");
  enter(Step::kToc);
}

void LogHandshake::on_toc(std::span<const std::uint8_t> packet, HostTime at) {
  toc_->on_frame(packet, at);
  if (toc_->failure()) return refuse(toc_->failure()->message, {});  // its length may have been damaged
  if (!toc_->finished()) return;
  request_ = PendingRequest(toc_->timer());
  if (toc_->came_from_cache()) restate_cached_toc();
  plan_blocks();
}

/// Only items that the session does not know yet.
void LogHandshake::restate_cached_toc() {
  for (const TocItem& item : toc_->items()) {
    const std::optional<CrtpPacket> reply = toc_item_reply(kLogTocTopic, item);
    if (reply && !session_->toc().has(item.id)) cached_replies_.push_back(*reply);
  }
}

void LogHandshake::plan_blocks() {
  plan_.clear();
  if (plan_block(1, kFast10ms, kOneBlock, {})) {
    if (plan_block(2, kFast10ms, kTiltBlock, kTiltBlockExtras)) plan_.back().optional = true;
  } else {
    plan_.clear();
    if (!plan_block(1, kFast10ms, kPositionBlock, kPositionBlockExtras) ||
        !plan_block(2, kFast10ms, kRangeBlock, kRangeBlockExtras)) {
      std::string missing;
      for (const std::string_view name : kPositionBlock)
        if (find_readable(*toc_, name) == nullptr) missing += ' ' + std::string(name);
      for (const std::string_view name : kRangeBlock)
        if (find_readable(*toc_, name) == nullptr) missing += ' ' + std::string(name);
      cache_->forget(kLogTocTopic.port, toc_->info());  // a damaged answer may have been stored
      return refuse("the vehicle's firmware does not offer the log variables" + missing +
                    ": update it to a release of 2022.09 or newer, built with the range module");
    }
  }
  if (plan_block(kSlowBlockId, kSlow10ms, {}, kSlowBlock)) plan_.back().optional = true;
  step_ = Step::kBlocks;
  block_ = 0;
  block_request_ = 0;
  send_block_request();
}

bool LogHandshake::plan_block(std::uint8_t id, std::uint8_t period_10ms,
                              std::span<const std::string_view> required,
                              std::span<const std::string_view> optional) {
  PlannedBlock planned;
  planned.id = id;
  planned.requests.push_back(log_block_request(LogCommand::kCreate, id));
  bool holds_anything = false;
  for (const std::span<const std::string_view> names : {required, optional}) {
    for (const std::string_view name : names) {
      const TocItem* const variable = find_readable(*toc_, name);
      if (variable == nullptr && names.data() == required.data()) return false;
      if (variable == nullptr) continue;
      holds_anything = true;
      const auto type = static_cast<std::uint8_t>(*log_type_of(variable->type));  // without flags
      if (add_log_entry(planned.requests.back(), type, variable->id)) continue;
      planned.requests.push_back(log_block_request(LogCommand::kAppend, id));
      static_cast<void>(add_log_entry(planned.requests.back(), type, variable->id));
    }
  }
  planned.requests.push_back(log_start_request(id, period_10ms));
  if (holds_anything) plan_.push_back(std::move(planned));
  return holds_anything;
}

void LogHandshake::on_block_reply(std::span<const std::uint8_t> packet) {
  if (packet[2] != plan_[block_].id) return;
  const auto command = static_cast<LogCommand>(packet[1]);
  const auto error = static_cast<LogError>(packet[3]);
  if (command == LogCommand::kDelete && (error == LogError::kNone || error == LogError::kUnknown)) {
    block_request_ = 0;
    return send_block_request();
  }
  if (error != LogError::kNone) return answer_refusal(command, error);
  next_block_request();
}

void LogHandshake::answer_refusal(LogCommand command, LogError error) {
  // It exists from a request whose reply was lost, or is gone with a reboot: remake it.
  const bool is_gone = error == LogError::kUnknown && command != LogCommand::kCreate;
  if (is_gone || (command == LogCommand::kCreate && error == LogError::kExists)) return remake_block();
  if (error == LogError::kUnknown && toc_->came_from_cache()) {
    cache_->forget(kLogTocTopic.port, toc_->info());  // its numbers are not the vehicle's: fetch them
    return enter(Step::kReset);
  }
  if (plan_[block_].optional) return next_block();
  const char* remedy = "";
  if (error == LogError::kNoRoom) remedy = ": its log is full; stop other clients";
  if (error == LogError::kUnknown) remedy = ": it does not know its own variables; restart it";
  if (error == LogError::kUnknownCommand) remedy = ": its firmware is too old; update it";
  refuse("the vehicle refuses log block " + std::to_string(plan_[block_].id) + ", command " +
         std::to_string(static_cast<int>(command)) + ", error " + std::to_string(static_cast<int>(error)) +
         remedy);
}

std::vector<std::uint8_t> LogHandshake::essential_blocks() const {
  std::vector<std::uint8_t> ids;
  for (const PlannedBlock& planned : plan_)
    if (!planned.optional) ids.push_back(planned.id);
  return ids;
}

void LogHandshake::next_block_request() {
  ++block_request_;
  if (block_request_ == plan_[block_].requests.size()) return next_block();
  send_block_request();
}

void LogHandshake::next_block() {
  ++block_;
  block_request_ = 0;
  if (block_ == plan_.size()) return enter(Step::kFinished);
  send_block_request();
}

void LogHandshake::send_block_request() {
  const CrtpPacket& request = plan_[block_].requests[block_request_];
  // A slow reply must not cost the block again and again.
  request_.ask(request, is_append(request) ? append_patience_ : 1);
}

void LogHandshake::remake_block() { request_.ask(log_block_request(LogCommand::kDelete, plan_[block_].id)); }

}  // namespace swiftlet
