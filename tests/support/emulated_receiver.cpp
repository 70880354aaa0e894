// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "tests/support/emulated_receiver.hpp"

#include <algorithm>

#include "firmware_link/crtp/crtp_packet.hpp"

namespace swiftlet {
namespace {

constexpr CrtpTopic kNullTopic{15, 3};
constexpr std::uint8_t kLinkBits = 0x0C;
constexpr std::uint8_t kUpBit = 0x08;
constexpr std::uint8_t kSafelink = 0x05;

// Measured on a Crazyradio PA at 2M: about 1 ms for a success, a few for a failure with three retries.
constexpr Duration kExchange = std::chrono::microseconds(1000);
constexpr Duration kRetry = std::chrono::microseconds(750);

PacketBytes copy_of(std::span<const std::uint8_t> bytes) {
  PacketBytes packet;
  for (const std::uint8_t byte : bytes) SWIFTLET_CHECK(packet.try_push_back(byte), "a packet has 31 bytes");
  return packet;
}

bool is_log_data(const PacketBytes& packet) { return is_on(bytes_of(packet), kLogDataTopic); }

bool is_safelink_request(std::span<const std::uint8_t> packet) {
  return packet.size() == 3 && is_on(packet, kNullTopic) && packet[1] == kSafelink;
}

}  // namespace

EmulatedReceiver::EmulatedReceiver(SimulatedVehicle& vehicle, std::uint64_t seed)
    : vehicle_(vehicle), packet_noise_(seed, "air_packet"), ack_noise_(seed, "air_ack") {}

AirExchange EmulatedReceiver::exchange(const AirSetting& dongle, std::span<const std::uint8_t> packet,
                                       int retransmissions) {
  AirExchange result;
  const bool listens = in_range && vehicle_.is_on_air() && dongle == setting;
  bool packet_lost = false;
  bool ack_lost = false;
  for (int attempt = 0; attempt <= retransmissions; ++attempt) {
    result.duration = kExchange + attempt * kRetry;
    if (!listens || packet.empty() || packet.size() > PacketBytes::capacity()) continue;
    if (attempt == 0 || !losses.retries_share_fate) {
      packet_lost = packet_noise_.chance(losses.packet);
      ack_lost = ack_noise_.chance(losses.ack);
    }
    if (packet_lost) continue;
    const PacketBytes payload = on_frame(packet);
    if (ack_lost) continue;
    result.acked = true;
    result.retries = attempt;
    result.payload = payload;
    return result;
  }
  return result;
}

/// The ACK is chosen before the vehicle's processor has even seen the packet: no answer is ever in it.
PacketBytes EmulatedReceiver::on_frame(std::span<const std::uint8_t> packet) {
  if (is_safelink_request(packet)) return echo_safelink_request(packet);
  const bool is_new = !safelink_ || ((packet[0] & kUpBit) != 0) != (up_ != 0);
  if (is_new) up_ ^= 1U;
  const bool last_arrived = !safelink_ || ((packet[0] & 0x04U) != 0) != (down_ != 0);
  if (last_arrived) {
    down_ ^= 1U;
    last_sent_ = next_downlink();
  }
  const PacketBytes payload = last_sent_;
  if (is_new) accept(packet);
  return payload;
}

PacketBytes EmulatedReceiver::echo_safelink_request(std::span<const std::uint8_t> packet) {
  safelink_ = packet[2] != 0;
  const bool keeps_silent = old_firmware && last_kind_ == Sent::kEcho;
  if (keeps_silent) {
    last_sent_ = next_downlink();
  } else {
    settle_last();
    last_kind_ = Sent::kEcho;
    last_sent_ = copy_of(packet);
  }
  up_ = 1;
  down_ = 1;
  return last_sent_;
}

/// What was sent last counts as arrived.
void EmulatedReceiver::settle_last() {
  const bool takes_one = last_kind_ == Sent::kQueued || (old_firmware && last_kind_ == Sent::kEcho);
  if (takes_one && !radio_queue_.empty()) radio_queue_.pop_front();
  refill_radio_queue();
}

PacketBytes EmulatedReceiver::next_downlink() {
  settle_last();
  const auto bit = static_cast<std::uint8_t>(down_ << 2U);
  if (radio_queue_.empty()) {
    last_kind_ = Sent::kIdle;
    return copy_of(std::array{static_cast<std::uint8_t>(0xF3 | bit)});
  }
  last_kind_ = Sent::kQueued;
  PacketBytes packet = radio_queue_.front();
  if (safelink_) packet[0] = static_cast<std::uint8_t>((packet[0] & ~kLinkBits) | bit);
  return packet;
}

void EmulatedReceiver::accept(std::span<const std::uint8_t> packet) {
  if (!is_on(packet, kNullTopic)) uplink_.push_back(copy_of(packet));
  for (const PacketBytes& answer : vehicle_.handle(packet)) queue(answer);
}

bool EmulatedReceiver::queue(const PacketBytes& packet) {
  refill_radio_queue();
  if (vehicle_queue_.size() == kVehicleQueue) {
    ++dropped_;
    return false;
  }
  vehicle_queue_.push_back(packet);
  return true;
}

void EmulatedReceiver::refill_radio_queue() {
  while (radio_queue_.size() < kRadioQueue && !vehicle_queue_.empty()) {
    radio_queue_.push_back(vehicle_queue_.front());
    vehicle_queue_.pop_front();
  }
}

void EmulatedReceiver::throw_away(std::deque<PacketBytes>& queue) {
  for (const PacketBytes& packet : queue)
    if (is_log_data(packet)) queued_log_.pop_back();
  dropped_ += queue.size();
  queue.clear();
}

void EmulatedReceiver::advance(Duration by) {
  constexpr Duration kTick = std::chrono::milliseconds(1);
  for (unlived_ += by; unlived_ >= kTick; unlived_ -= kTick) {
    const std::vector<SentPacket> all_sent = vehicle_.advance(vehicle_.now() + kTick);
    follow_vehicle();
    for (const SentPacket& sent : all_sent) {
      const bool has_room = queue(sent.bytes);
      if (has_room && is_log_data(sent.bytes)) queued_log_.push_back(sent);
    }
  }
}

/// A vehicle that takes the radio for dead empties its own queue; one that boots restarts the chip too.
void EmulatedReceiver::follow_vehicle() {
  if (vehicle_.flushes() == flushes_) return;
  flushes_ = vehicle_.flushes();
  throw_away(vehicle_queue_);
  if (vehicle_.is_on_air()) return;
  settle_last();
  throw_away(radio_queue_);
  last_kind_ = Sent::kIdle;
  safelink_ = false;
  up_ = 1;
  down_ = 1;
}

}  // namespace swiftlet
