// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "firmware_link/session/live_session.hpp"

#include <algorithm>
#include <chrono>
#include <utility>

namespace swiftlet {
namespace {

using Kind = VehicleEvent::Kind;

// The firmware's watchdog: after that long without a packet it deletes the log blocks.
constexpr Duration kMaxSilence = std::chrono::seconds(1);
constexpr Duration kTryAgainAfter = std::chrono::seconds(5);
// Each request is repeated once a second or more, so packet loss alone hardly lasts that long; no vehicle is
// exchanged sooner.
constexpr Duration kMaxHandshakeSilence = std::chrono::seconds(6);
constexpr Duration kProgressPeriod = std::chrono::seconds(2);
// No answer to a question of this program comes later after the last one.
constexpr Duration kLateAnswer = std::chrono::seconds(2);

}  // namespace

LiveSession::LiveSession(const LogSession& session, TocCache& cache, bool is_shared)
    : session_(session),
      cache_(cache),
      handshake_(session, cache),
      inventory_(cache),
      monitor_(session),
      is_shared_(is_shared) {}

std::optional<CrtpPacket> LiveSession::next_request(HostTime now) {
  watch_for_silence(now);
  if (refused_at_ && now - *refused_at_ >= kTryAgainAfter) restart();
  report_progress(now);
  if (!handshake_.finished()) return handshake_.next_request(now);
  if (!inventory_.finished()) return inventory_.next_request(now);
  return round_trip_.next_request(now);
}

void LiveSession::watch_for_silence(HostTime now) {
  if (handshake_.finished()) {
    const auto has_stopped = [now](const Stream& stream) { return now - stream.data_at > kMaxSilence; };
    if (std::ranges::none_of(streams_, has_stopped)) return;
    report(Kind::kDataStopped);
    if (received_at_ && now - *received_at_ < kMaxSilence) other_program_.on_log_stopped(now);
    restart();
  } else if (received_at_ && !refused_at_ && now - *received_at_ > kMaxHandshakeSilence) {
    restart();
  }
}

/// Of what makes the user wait.
void LiveSession::report_progress(HostTime now) {
  const std::optional<double> share = handshake_.toc_progress();
  if (!share) return progress_at_.reset();
  if (!progress_at_) progress_at_ = now;
  if (now - *progress_at_ < kProgressPeriod) return;
  progress_at_ = now;
  report(Kind::kReadingTable, static_cast<std::int32_t>(100.0 * *share));
}

void LiveSession::restart() {
  handshake_ = LogHandshake(session_, cache_);
  inventory_ = VehicleInventory(cache_);
  inventory_at_.reset();
  monitor_.restart();
  round_trip_.restart();
  streams_.clear();
  received_at_.reset();
  refused_at_.reset();
}

void LiveSession::on_frame(const LinkFrame& frame, const std::optional<LogRecord>& record) {
  if (!handshake_.finished()) return on_handshake(frame);
  received_at_ = frame.at;
  watch_for_others(frame, record);
  if (record) {
    for (Stream& stream : streams_)
      if (stream.block == record->block_id) stream.data_at = frame.at;
    monitor_.on_frame(*record);
    if (record->boot != boot_) report(Kind::kRebooted);
    boot_ = record->boot;
  }
  round_trip_.on_frame(frame.packet(), frame.at);
  on_inventory(frame);
}

void LiveSession::watch_for_others(const LinkFrame& frame, const std::optional<LogRecord>& record) {
  if (record) other_program_.on_record(*record);
  if (is_shared_ || !inventory_at_ || frame.at - *inventory_at_ < kLateAnswer) return;
  other_program_.on_frame(frame.packet(), frame.at);
}

void LiveSession::on_handshake(const LinkFrame& frame) {
  if (refused_at_) return;
  received_at_ = frame.at;
  handshake_.on_frame(frame.packet(), frame.at);
  if (handshake_.failure()) {
    refused_at_ = frame.at;
    if (was_connected_) return report(Kind::kRefused);
    failure_ = handshake_.failure();
  } else if (handshake_.finished()) {
    was_connected_ = true;
    for (const std::uint8_t block : handshake_.essential_blocks())
      static_cast<void>(streams_.try_push_back({block, frame.at}));
    report(Kind::kConnected, handshake_.protocol());
    if (handshake_.protocol() > kNewestProtocol) report(Kind::kProtocolNewer, handshake_.protocol());
  }
}

void LiveSession::on_inventory(const LinkFrame& frame) {
  inventory_.on_frame(frame.packet(), frame.at);
  restate_cached_params();
  if (!inventory_.finished() || inventory_at_) return;
  inventory_at_ = frame.at;
  if (inventory_.has_multiranger() == false) report(Kind::kNoMultiranger);
  if (inventory_.has_flow_deck() == false) report(Kind::kNoFlowDeck);
}

/// Once for each table: what was sent or restated before is known.
void LiveSession::restate_cached_params() {
  const TocDownload& toc = inventory_.toc();
  if (!toc.finished() || known_params_ == toc.info()) return;
  known_params_ = toc.info();
  if (!toc.came_from_cache()) return;
  for (const TocItem& item : toc.items())
    if (const std::optional<CrtpPacket> reply = toc.reply_of(item)) cached_params_.push_back(*reply);
}

std::vector<CrtpPacket> LiveSession::take_cached_replies() {
  if (!cached_params_.empty()) return std::exchange(cached_params_, {});
  return handshake_.take_cached_replies();
}

void LiveSession::report(Kind kind, std::int32_t value) {
  static_cast<void>(events_.try_push_back({kind, value}));
}

std::optional<VehicleEvent> LiveSession::take_event() {
  if (events_.empty()) {
    if (const std::optional<VehicleEvent> event = other_program_.take_event()) return event;
    return monitor_.take_event();
  }
  const VehicleEvent event = events_.front();
  events_.erase(0);
  return event;
}

}  // namespace swiftlet
