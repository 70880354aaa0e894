// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "tools/doctor/vehicle_interview.hpp"

#include <chrono>

#include "firmware_link/link/link_packet.hpp"

namespace swiftlet {
namespace {

constexpr Duration kReceiveTimeout = std::chrono::milliseconds(20);
// Health comes with the log; on older firmware not all of it.
constexpr Duration kHealthTimeout = std::chrono::seconds(2);
constexpr Duration kFarewell = std::chrono::milliseconds(100);

/// Blocks that nobody listens to would run on: on USB and UDP for ever.
void say_farewell(Link& link, LinkClock& clock) {
  static_cast<void>(link.send(bytes_of(log_reset_request())));
  const HostTime until = clock.now() + kFarewell;
  while (clock.now() < until) static_cast<void>(link.receive(kReceiveTimeout));
}

}  // namespace

std::optional<CrtpPacket> VehicleInterview::next_request(HostTime now) {
  return log_ended_at_ ? inventory_.next_request(now) : handshake_.next_request(now);
}

void VehicleInterview::on_frame(const LinkFrame& frame) {
  const std::optional<LogRecord> record = session_.on_frame(frame);
  if (frame.direction != LinkDirection::kFromVehicle) return;
  answered_ = true;
  if (record) {
    logs_ = true;
    monitor_.on_frame(*record);
  }
  if (log_ended_at_) return inventory_.on_frame(frame.packet(), frame.at);
  handshake_.on_frame(frame.packet(), frame.at);
  for (const CrtpPacket& reply : handshake_.take_cached_replies())
    static_cast<void>(session_.on_frame(frame_of(LinkDirection::kFromVehicle, frame.at, bytes_of(reply))));
  if (handshake_.finished() || handshake_.failure()) log_ended_at_ = frame.at;
}

bool VehicleInterview::finished(HostTime now) const {
  if (!log_ended_at_) return false;
  if (handshake_.failure() && handshake_.protocol() < kOldestProtocol) return true;
  if (!inventory_.finished()) return false;
  const VehicleHealth& health = monitor_.health();
  return handshake_.failure() || (health.battery_mv && health.is_flying) ||
         now - *log_ended_at_ >= kHealthTimeout;
}

VehicleFacts VehicleInterview::facts() const {
  return {.answered = answered_,
          .protocol = handshake_.protocol(),
          .firmware = inventory_.firmware(),
          .device_type = inventory_.device_type(),
          .has_multiranger = inventory_.has_multiranger(),
          .has_flow_deck = inventory_.has_flow_deck(),
          .refusal = handshake_.failure(),
          .logs = logs_,
          .health = monitor_.health()};
}

VehicleFacts interview_vehicle(Link& link, LinkClock& clock, TocCache& cache,
                               const InterviewPatience& patience) {
  VehicleInterview interview(cache);
  const HostTime begin = clock.now();
  const auto is_hopeless = [&](HostTime now) {
    return now - begin >= patience.all || (!interview.answered() && now - begin >= patience.first_answer);
  };
  for (HostTime now = begin; !interview.finished(now) && !is_hopeless(now); now = clock.now()) {
    if (const std::optional<CrtpPacket> request = interview.next_request(now))
      static_cast<void>(link.send(bytes_of(*request)));
    if (const Result<LinkFrame> frame = link.receive(kReceiveTimeout)) interview.on_frame(*frame);
  }
  VehicleFacts facts = interview.facts();
  facts.link = link.statistics().condition;
  if (facts.answered) say_farewell(link, clock);
  return facts;
}

}  // namespace swiftlet
