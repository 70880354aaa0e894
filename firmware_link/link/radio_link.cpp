// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "firmware_link/link/radio_link.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <utility>
#include <variant>

#include "core/base/check.hpp"
#include "firmware_link/link/link_condition.hpp"
#include "firmware_link/link/link_packet.hpp"

namespace swiftlet {
namespace {

constexpr Duration kBusyPause = std::chrono::milliseconds(5);
constexpr Duration kIdlePause = std::chrono::milliseconds(10);
constexpr Duration kIdleAfter = std::chrono::seconds(1);
constexpr Duration kSilentPause = std::chrono::milliseconds(50);
constexpr Duration kMaxPollPause = std::chrono::milliseconds(500);
constexpr Duration kAskPeriodInSilence = std::chrono::seconds(1);
constexpr int kMaxUnansweredAsks = 10;
// With both counters in step there are no repeats. A vehicle that has rebooted meanwhile has no safelink, and
// half of its packets look like repeats.
constexpr int kMaxRepeats = 5;
constexpr Duration kRepeatWindow = std::chrono::seconds(1);

Duration pause_between(std::optional<int> rate_limit_hz) {
  if (!rate_limit_hz) return Duration::zero();
  return std::min(kMaxPollPause, Duration(std::chrono::seconds(1)) / std::max(1, *rate_limit_hz));
}

}  // namespace

RadioLink::RadioLink(UsbBus& bus, LinkClock& clock, RadioAddress address)
    : bus_(bus), clock_(clock), address_(std::move(address)), received_at_(clock.now()) {
  statistics_.condition = LinkCondition::kSilent;
  negotiate_safelink();
}

Result<LinkFrame> RadioLink::receive(Duration timeout) {
  HostTime now = clock_.now();
  const HostTime deadline = now + timeout;
  for (;;) {
    client_waits_ = uplink_.client_waits();
    if (to_deliver_.empty() && now - pause() >= acted_at_) {
      acted_at_ = now;
      if (!silent_ && now - received_at_ >= kLinkSilence) fall_silent();
      if (!radio_) open(now);
      if (radio_) exchange();
    }
    if (!to_deliver_.empty()) {
      const LinkFrame frame = to_deliver_.front();
      to_deliver_.erase_front(1);
      return frame;
    }
    now = clock_.now();
    if (now >= deadline) return Error{ErrorCode::kTimeout, "no packet"};  // short: not on the heap
    const HostTime next = std::min(deadline, acted_at_ + pause());
    if (next > now) uplink_.sleep_for(next - now, clock_);
    now = std::max(now, clock_.now());
  }
}

Status RadioLink::send(std::span<const std::uint8_t> packet) {
  if (unacknowledged_ && has_content(packet) && is_same_packet(bytes_of(*unacknowledged_), packet)) return {};
  return uplink_.push(packet);
}

void RadioLink::open(HostTime now) {
  if (!reopen_.is_due(bus_, now)) return;
  std::variant<Crazyradio, UsbOutcome> opened = Crazyradio::open(bus_, address_);
  if (const UsbOutcome* failure = std::get_if<UsbOutcome>(&opened)) {
    statistics_.condition = condition_of(*failure);
    return;
  }
  radio_.emplace(std::get<Crazyradio>(std::move(opened)));
  // Its index changes when it or another one is plugged in.
  if (address_.dongle != "*" && !radio_->serial().empty()) address_.dongle = radio_->serial();
  failures_in_a_row_ = 0;
  active_at_ = now;
  negotiate_safelink();
}

void RadioLink::lose_dongle(UsbOutcome failure) {
  radio_.reset();
  give_up_unacknowledged();
  ++statistics_.device_losses;
  statistics_.condition = condition_of(failure);
  statistics_.safelink = false;
}

Duration RadioLink::pause() const {
  Duration pause = kBusyPause;
  if (!radio_)
    pause = ReopenSchedule::kCheckPeriod;
  else if (silent_)
    pause = kSilentPause;
  else if (client_waits_ || is_repeating_for_client() ||
           (was_acknowledged_ && (has_more_ || mode_ == Mode::kAsking || uplink_.request_waits())))
    pause = Duration::zero();
  else if (acted_at_ - kIdleAfter >= active_at_)
    pause = kIdlePause;
  return radio_ ? std::max(pause, pause_between(address_.rate_limit_hz)) : pause;
}

/// A packet of the client does not wait for the next poll to be sent again.
bool RadioLink::is_repeating_for_client() const {
  return !sent_is_ours_ && unacknowledged_ && has_content(bytes_of(*unacknowledged_));
}

void RadioLink::exchange() {
  const HostTime now = acted_at_ = clock_.now();
  const CrtpPacket packet = next_packet(now);
  const RadioAnswer answer = radio_->exchange(bytes_of(packet));
  was_acknowledged_ = answer.acknowledged;
  has_more_ = false;
  failures_in_a_row_ = answer.outcome == UsbOutcome::kDone ? 0 : failures_in_a_row_ + 1;
  last_outcome_ = answer.outcome;
  if (!answer.may_go_on() || failures_in_a_row_ >= ReopenSchedule::kMaxFailuresInARow)
    return lose_dongle(answer.outcome);
  ++statistics_.packets_sent;
  if (answer.outcome == UsbOutcome::kTimeout) ++statistics_.usb_timeouts;
  if (sent_ == Sent::kRequest) {
    LinkFrame sent = frame_of(LinkDirection::kToVehicle, now, bytes_of(packet));
    sent.is_ours = sent_is_ours_;
    hand_back(sent);
  }
  if (answer.acknowledged)
    on_frame(answer, clock_.now());
  else if (answer.outcome == UsbOutcome::kDone && statistics_.condition != LinkCondition::kConnected)
    statistics_.condition = LinkCondition::kSilent;  // the dongle works again
}

void RadioLink::fall_silent() {
  silent_ = true;
  ++statistics_.silences;
  if (statistics_.condition == LinkCondition::kConnected)
    statistics_.condition =
        last_outcome_ == UsbOutcome::kDone ? LinkCondition::kSilent : condition_of(last_outcome_);
  uplink_.clear_requests();
  negotiate_safelink();
}

void RadioLink::negotiate_safelink() {
  mode_ = Mode::kAsking;
  sent_ = Sent::kPoll;
  unanswered_asks_ = 0;
  give_up_unacknowledged();
  statistics_.safelink = false;
}

void RadioLink::give_up_unacknowledged() {
  if (is_repeating_for_client()) uplink_.take_back(*unacknowledged_);
  unacknowledged_.reset();
}

CrtpPacket RadioLink::next_packet(HostTime now) {
  if (mode_ == Mode::kAsking) {
    // Not twice in a row: a vehicle whose confirmation was lost answers only after another packet.
    const bool asks = silent_ ? now - kAskPeriodInSilence >= asked_at_ : sent_ != Sent::kAsk;
    sent_ = asks ? Sent::kAsk : Sent::kPoll;
    if (asks) asked_at_ = now;
    return asks ? packet_of(safelink_request(address_.safelink)) : packet_of(kRadioPollPacket);
  }
  if (unacknowledged_) {
    sent_ = Sent::kPoll;  // a request among them was delivered already
    return *unacknowledged_;
  }
  std::optional<UplinkQueue::Packet> waiting;
  if (!silent_) waiting = uplink_.next();
  sent_ = waiting ? Sent::kRequest : Sent::kPoll;
  if (waiting) active_at_ = now;
  sent_is_ours_ = !waiting || waiting->is_ours;
  CrtpPacket packet = waiting ? waiting->bytes : packet_of(kRadioPollPacket);
  if (mode_ == Mode::kSafelink) {
    packet[0] = safelink_.header(packet[0]);
    unacknowledged_ = packet;
  }
  return packet;
}

void RadioLink::hand_back(const LinkFrame& frame) {
  SWIFTLET_CHECK(to_deliver_.try_push_back(frame), "an exchange yields two frames at most");
}

void RadioLink::on_frame(const RadioAnswer& answer, HostTime now) {
  ++statistics_.packets_acked;
  statistics_.radio_retries += answer.retries;
  statistics_.condition = LinkCondition::kConnected;
  received_at_ = now;
  silent_ = false;
  unacknowledged_.reset();
  const std::span<const std::uint8_t> payload(answer.payload.data(), answer.payload.size());
  switch (mode_) {
    case Mode::kAsking:
      return on_while_asking(payload, now);
    case Mode::kSafelink:
      return on_by_safelink(payload, now);
    case Mode::kPlain:
      return on_content(payload, now);
  }
}

void RadioLink::on_while_asking(std::span<const std::uint8_t> payload, HostTime now) {
  if (sent_ == Sent::kAsk) {
    if (is_safelink_echo(payload, address_.safelink)) {
      safelink_.restart();
      mode_ = address_.safelink ? Mode::kSafelink : Mode::kPlain;
      statistics_.safelink = address_.safelink;
      return;
    }
    if (++unanswered_asks_ >= kMaxUnansweredAsks) mode_ = Mode::kPlain;
  }
  // The vehicle's counters are unknown: it may repeat its last packet.
  if (last_received_ && is_same_packet(bytes_of(*last_received_), payload)) {
    ++statistics_.duplicates;
    return;
  }
  on_content(payload, now);
}

void RadioLink::on_by_safelink(std::span<const std::uint8_t> payload, HostTime now) {
  if (safelink_.acknowledged(payload) != Safelink::Payload::kRepeat) return on_content(payload, now);
  if (!is_null_packet(payload)) ++statistics_.duplicates;
  if (now - kRepeatWindow >= repeats_since_) {
    repeats_since_ = now;
    repeats_ = 0;
  }
  if (++repeats_ < kMaxRepeats) return;
  repeats_ = 0;
  negotiate_safelink();
}

void RadioLink::on_content(std::span<const std::uint8_t> payload, HostTime now) {
  if (!has_content(payload)) return;
  ++statistics_.packets_received;
  active_at_ = now;
  has_more_ = true;
  last_received_ = packet_of(payload);
  hand_back(frame_of(LinkDirection::kFromVehicle, now, payload));
}

}  // namespace swiftlet
