// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "tests/support/emulated_crazyradio.hpp"

#include <algorithm>
#include <utility>

namespace swiftlet {
namespace {

constexpr int kLastChannel = 125;
constexpr int kLastChannelOf2 = 100;
constexpr std::size_t kMaxPacket = 32;
// One in the endpoint and one behind it: then the dongle no longer looks at its OUT endpoint.
constexpr std::size_t kMaxAnswers = 2;
constexpr std::uint8_t kAcked = 0x01;

std::vector<std::uint8_t> answer_of(const AirExchange& exchange) {
  if (!exchange.acked) return {0x00};
  std::vector<std::uint8_t> bytes{static_cast<std::uint8_t>(kAcked | exchange.retries << 4)};
  bytes.insert(bytes.end(), exchange.payload.begin(), exchange.payload.end());
  return bytes;
}

}  // namespace

std::vector<VendorRequest> requests_at_opening() {
  return {{0x22, 0, 0, {}},
          {0x03, 2, 0, {}},
          {0x01, 80, 0, {}},
          {0x20, 0, 0, {}},
          {0x02, 0, 0, {0xE7, 0xE7, 0xE7, 0xE7, 0xE7}},
          {0x04, 3, 0, {}},
          {0x06, 3, 0, {}},
          {0x05, 0xA0, 0, {}},
          {0x10, 1, 0, {}}};
}

void EmulatedCrazyradio::unplug() {
  plugged_in_ = false;
  settings_ = {};
  answers_.clear();
  out_halted_ = false;
  in_halted_ = false;
}

void EmulatedCrazyradio::plug_in() {
  plugged_in_ = true;
  ++bus_address_;
}

void EmulatedCrazyradio::advance(Duration by) {
  now_ += by;
  receiver_.advance(by);
}

UsbOutcome EmulatedCrazyradio::control_out(const VendorRequest& request) {
  if (!plugged_in_) return UsbOutcome::kNoDevice;
  if (!apply(request)) return UsbOutcome::kStall;
  requests_.push_back(request);
  return UsbOutcome::kDone;
}

bool EmulatedCrazyradio::apply(const VendorRequest& request) {
  switch (request.request) {
    case 0x01:
      if (request.value <= kLastChannel) settings_.air.channel = request.value;
      return true;
    case 0x02:
      // With fewer than five bytes it answers too, but no vehicle has such an address.
      if (request.data.size() < 3 || request.data.size() > 5) return false;
      settings_.air.address = {};
      std::ranges::copy(request.data, settings_.air.address.begin());
      return true;
    case 0x03:
      if (request.value <= 2) settings_.air.rate = static_cast<RadioRate>(request.value);
      return true;
    case 0x04:  // power
    case 0x05:  // retransmission delay
      return true;
    case 0x06:
      settings_.retransmissions = request.value & 0x0F;
      return true;
    case 0x10:
      settings_.ack = request.value != 0;
      return true;
    case 0x20:
      settings_.carrier = request.value != 0;
      return true;
    default:
      return apply_of_model(request);
  }
}

bool EmulatedCrazyradio::apply_of_model(const VendorRequest& request) {
  const bool is_pa = model_ == DongleModel::kPa;
  switch (request.request) {
    case 0x22:
      if (is_pa) settings_.mode = request.value;
      return true;
    case 0x24:
      if (is_pa || request.value > 1) return false;
      settings_.is_sniffing = request.value == 1;
      return true;
    case 0x30:
      if (is_pa) settings_.mode = 0xFF;  // a register of its radio: no longer what it was
      if (!is_pa && !request.data.empty()) settings_.packet_loss = request.data[0];
      return true;
    default:
      return false;
  }
}

/// A Crazyradio 2.0 accepts a rate and channels that it does not have.
bool EmulatedCrazyradio::reaches_the_air() const {
  const bool is_tunable = model_ == DongleModel::kPa || (settings_.air.rate != RadioRate::k250Kbps &&
                                                         settings_.air.channel <= kLastChannelOf2);
  return settings_.sends() && is_tunable;
}

std::optional<DongleFault> EmulatedCrazyradio::take_fault() {
  if (next_faults_.empty()) return standing_fault;
  const DongleFault next = next_faults_.front();
  next_faults_.pop_front();
  return next;
}

UsbOutcome EmulatedCrazyradio::bulk_out(std::span<const std::uint8_t> bytes) {
  if (!plugged_in_) return UsbOutcome::kNoDevice;
  if (out_halted_) return UsbOutcome::kStall;
  if (settings_.carrier || answers_.size() == kMaxAnswers) return UsbOutcome::kTimeout;
  const std::optional<DongleFault> now = take_fault();
  if (now == DongleFault::kStallOut) {
    out_halted_ = true;
    return UsbOutcome::kStall;
  }
  if (now == DongleFault::kNoAnswer) return UsbOutcome::kDone;
  const auto packet = bytes.first(std::min(bytes.size(), kMaxPacket));
  const AirExchange exchange = reaches_the_air()
                                   ? receiver_.exchange(settings_.air, packet, settings_.retransmissions)
                                   : AirExchange{};
  ++packets_sent_;
  if (!settings_.ack) return UsbOutcome::kDone;
  Answer answer{answer_of(exchange), now_ + exchange.duration, now == DongleFault::kOverflow};
  if (now == DongleFault::kLateAnswer) answer.ready_at += late_by;
  in_halted_ = in_halted_ || now == DongleFault::kStallIn;
  answers_.push_back(std::move(answer));
  return UsbOutcome::kDone;
}

UsbTransfer EmulatedCrazyradio::bulk_in(std::span<std::uint8_t> buffer) {
  if (!plugged_in_) return {UsbOutcome::kNoDevice, 0};
  if (in_halted_) return {UsbOutcome::kStall, 0};
  if (answers_.empty() || answers_.front().ready_at > now_) return {UsbOutcome::kTimeout, 0};
  const Answer answer = std::move(answers_.front());
  answers_.pop_front();
  const std::size_t size = std::min(buffer.size(), answer.bytes.size());
  std::copy_n(answer.bytes.begin(), size, buffer.begin());
  const bool fits = size == answer.bytes.size() && !answer.too_long;
  return {fits ? UsbOutcome::kDone : UsbOutcome::kOverflow, size};
}

std::optional<Duration> EmulatedCrazyradio::answer_in() const {
  if (!plugged_in_ || in_halted_) return Duration::zero();
  if (answers_.empty()) return std::nullopt;
  return std::max(answers_.front().ready_at - now_, Duration::zero());
}

UsbOutcome EmulatedCrazyradio::clear_halt(std::uint8_t endpoint) {
  if (!plugged_in_) return UsbOutcome::kNoDevice;
  (endpoint == kIn ? in_halted_ : out_halted_) = false;
  return UsbOutcome::kDone;
}

UsbOutcome EmulatedCrazyradio::reset() {
  if (!plugged_in_) return UsbOutcome::kNoDevice;
  out_halted_ = false;
  in_halted_ = false;
  answers_.clear();
  return UsbOutcome::kDone;
}

}  // namespace swiftlet
