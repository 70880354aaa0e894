// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "firmware_link/sharing/client_traffic.hpp"

#include "firmware_link/crtp/crtp_packet.hpp"
#include "firmware_link/link/link_packet.hpp"

namespace swiftlet {
namespace {

constexpr std::uint8_t kSetpointPort = 3;
constexpr std::uint8_t kGenericSetpointPort = 7;
constexpr std::uint8_t kHighLevelPort = 8;

bool is_reset(std::span<const std::uint8_t> packet) {
  return is_on(packet, kLogControlTopic) && packet.size() > 1 &&
         packet[1] == static_cast<std::uint8_t>(LogCommand::kReset);
}

}  // namespace

bool is_steering(std::span<const std::uint8_t> packet) {
  if (packet.empty()) return false;
  const unsigned port = packet[0] >> 4U;
  return port == kSetpointPort || port == kGenericSetpointPort || port == kHighLevelPort;
}

void ClientTraffic::take(std::span<const std::uint8_t> packet, HostTime now) {
  if (!has_content(packet)) return;
  if (is_steering(packet)) {
    if (!steering_.try_push({packet_of(packet), now})) ++counters_.steering_dropped;
  } else if (!requests_.try_push(packet_of(packet))) {
    ++counters_.requests_dropped;
  }
}

bool ClientTraffic::has_packet(HostTime now) const {
  const bool has_request =
      blocks_.deletion_is_due(now) || (!blocks_.is_resetting() && !requests_.empty()) || taken_back_;
  return !steering_.empty() || (log_was_reset_ && has_request);
}

std::optional<CrtpPacket> ClientTraffic::next_packet(bool owner_waits, HostTime now) {
  if (!steering_.empty() && steering_in_a_row_ < kMaxSteeringInARow) return next_steering(now);
  steering_in_a_row_ = 0;
  if (owner_waits && was_clients_) {
    was_clients_ = false;
    return std::nullopt;
  }
  std::optional<CrtpPacket> request = next_request(now);
  was_clients_ = request.has_value();
  if (!request && !owner_waits && !steering_.empty()) return next_steering(now);
  return request;
}

/// Precondition: there is one.
std::optional<CrtpPacket> ClientTraffic::next_steering(HostTime now) {
  for (; is_overtaken(now); ++counters_.steering_dropped) steering_.pop();
  const CrtpPacket packet = steering_.front().packet;
  steering_.pop();
  ++steering_in_a_row_;
  return packet;
}

/// Whether the oldest is a setpoint that came long ago, and has a newer one behind it.
bool ClientTraffic::is_overtaken(HostTime now) const {
  const unsigned header = steering_.front().packet[0] & kTopicBits;
  if (header >> 4U == kHighLevelPort || now - steering_.front().came_at < kSetpointLife) return false;
  for (std::size_t i = 1; i < steering_.size(); ++i)
    if ((steering_[i].packet[0] & kTopicBits) == header) return true;
  return false;
}

std::optional<CrtpPacket> ClientTraffic::next_request(HostTime now) {
  if (!log_was_reset_) return std::nullopt;
  if (taken_back_) return std::exchange(taken_back_, std::nullopt);
  if (const std::optional<CrtpPacket> deletion = blocks_.next_deletion(now)) return deletion;
  while (!blocks_.is_resetting() && !requests_.empty()) {
    const CrtpPacket packet = requests_.front();
    requests_.pop();
    const std::optional<CrtpPacket> translated = translate(packet);
    if (!translated) continue;
    open_.sent(bytes_of(*translated));
    return translated;
  }
  // A reset deletes blocks first.
  return blocks_.next_deletion(now);
}

/// nullopt: the vehicle is not asked.
std::optional<CrtpPacket> ClientTraffic::translate(const CrtpPacket& packet) {
  if (!is_on(bytes_of(packet), kLogControlTopic)) return packet;
  const ClientLogBlocks::Outcome outcome = blocks_.on_request(bytes_of(packet));
  if (outcome.answer) static_cast<void>(answers_.try_push(*outcome.answer));
  return outcome.request;
}

void ClientTraffic::drop_steering() {
  counters_.steering_dropped += steering_.size();
  steering_.clear();
}

void ClientTraffic::take_back(const CrtpPacket& packet) {
  if (!is_steering(bytes_of(packet))) taken_back_ = packet;
}

std::optional<CrtpPacket> ClientTraffic::on_frame(LinkFrame& frame) {
  if (frame.direction == LinkDirection::kToVehicle) {
    if (frame.is_ours) on_sent_by_owner(frame.packet());
    return std::nullopt;
  }
  if (is_on(frame.packet(), kLogDataTopic)) return on_log_data(frame);
  if (is_on(frame.packet(), kLogControlTopic)) return on_log_control(frame);
  if (answers_a_request(frame.packet())) return on_answer(frame);
  return packet_of(frame.packet());
}

void ClientTraffic::on_sent_by_owner(std::span<const std::uint8_t> packet) {
  owners_open_.sent(packet);
  if (is_reset(packet)) log_was_reset_ = false;
}

/// Only the owner resets the vehicle's log. A second answer is to a repetition, which the vehicle received
/// before anything of the client.
std::optional<CrtpPacket> ClientTraffic::on_log_control(LinkFrame& frame) {
  const std::span<const std::uint8_t> packet = frame.packet();
  if (is_reset(packet)) {
    if (std::exchange(log_was_reset_, true)) return std::nullopt;
    has_lost_blocks_ = blocks_.forget_all() || has_lost_blocks_;
    if (taken_back_ && is_on(bytes_of(*taken_back_), kLogControlTopic)) taken_back_.reset();
    return std::nullopt;
  }
  frame.is_ours = packet.size() < 3 || !ClientLogBlocks::has_number(packet[2]);
  if (frame.is_ours) return std::nullopt;
  return blocks_.on_answer(packet);
}

std::optional<CrtpPacket> ClientTraffic::on_log_data(LinkFrame& frame) {
  const std::span<const std::uint8_t> packet = frame.packet();
  frame.is_ours = packet.size() < 2 || !ClientLogBlocks::has_number(packet[1]);
  if (frame.is_ours) return std::nullopt;
  return blocks_.on_data(packet);
}

/// To all that have asked: to the same question the vehicle has the same answer. What nobody has asked for is
/// the owner's, who ignores it.
std::optional<CrtpPacket> ClientTraffic::on_answer(LinkFrame& frame) {
  const bool is_clients = open_.take_answer(frame.packet());
  if (is_clients && is_missing_item(frame.packet())) {  // the owner asks for none that is missing
    frame.is_ours = false;
  } else {
    const bool is_owners = owners_open_.take_answer(frame.packet());
    frame.is_ours = is_owners || !is_clients;
  }
  if (!is_clients) return std::nullopt;
  return packet_of(frame.packet());
}

std::optional<CrtpPacket> ClientTraffic::take_answer() {
  if (!answers_.empty()) {
    const CrtpPacket answer = answers_.front();
    answers_.pop();
    return answer;
  }
  return blocks_.take_reset_answer();
}

void ClientTraffic::abandon() {
  requests_.clear();
  taken_back_.reset();
  answers_.clear();
  open_.clear();
  blocks_.abandon();
}

}  // namespace swiftlet
