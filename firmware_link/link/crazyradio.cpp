// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "firmware_link/link/crazyradio.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <chrono>
#include <optional>
#include <utility>
#include <vector>

#include "core/base/check.hpp"
#include "firmware_link/link/uri_text.hpp"

namespace swiftlet {
namespace {

constexpr std::uint8_t kDongleOut = 0x01;
constexpr std::uint8_t kDongleIn = 0x81;

constexpr std::uint8_t kSetChannel = 0x01;
constexpr std::uint8_t kSetAddress = 0x02;
constexpr std::uint8_t kSetRate = 0x03;
constexpr std::uint8_t kSetPower = 0x04;
constexpr std::uint8_t kSetRetryDelay = 0x05;
constexpr std::uint8_t kSetRetries = 0x06;
constexpr std::uint8_t kSetAcknowledge = 0x10;
constexpr std::uint8_t kSetCarrier = 0x20;
constexpr std::uint8_t kSetModeOfPa = 0x22;
constexpr std::uint8_t kSetRadioModeOf2 = 0x24;
// Never to be sent to a Crazyradio PA, which takes it for a register of its radio.
constexpr std::uint8_t kSimulateLossOf2 = 0x30;

constexpr std::uint16_t kFullPower = 3;
constexpr std::uint16_t kDelayFor32Bytes = 0xA0;
constexpr std::uint8_t kUsualRetries = 3;

// Longer than the 200 ms after which a Crazyradio 2.0 gives a packet up by itself.
constexpr Duration kInTimeout = std::chrono::milliseconds(250);
constexpr Duration kQuiet = std::chrono::milliseconds(10);
// Longer than any packet takes, retransmissions at 250 kbit/s included.
constexpr Duration kLongQuiet = std::chrono::milliseconds(25);
constexpr int kMaxStaleAnswers = 16;

/// The index, if the name is one and not a serial number.
std::optional<std::size_t> index_in(const std::string& name) {
  std::size_t index = 0;
  const auto [end, error] = std::from_chars(name.data(), name.data() + name.size(), index);
  const bool is_number = error == std::errc() && end == name.data() + name.size();
  return is_number && name.size() < 10 ? std::optional(index) : std::nullopt;
}

using Opened = std::variant<std::unique_ptr<UsbDevice>, UsbOutcome>;

Opened open_dongle(UsbBus& bus, const UsbIdentity& identity, const RadioAddress& address) {
  // Permission may be granted at this moment, but this may not be the dongle that was requested.
  if (identity.access == UsbOutcome::kAccessDenied) return identity.access;
  if (identity.release_bcd < kOldestCrazyradioRelease) return UsbOutcome::kFault;
  if (!radio_range(is_crazyradio_2(identity)).holds(address)) return UsbOutcome::kUnsuited;
  return bus.open(identity, 0);
}

/// A client that crashed leaves the dongle in any state.
Opened open_and_reset(UsbBus& bus, const UsbIdentity& identity, const RadioAddress& address) {
  Opened opened = open_dongle(bus, identity, address);
  if (opened.index() == 1) return opened;
  const UsbOutcome outcome = std::get<0>(opened)->reset();
  if (outcome == UsbOutcome::kDone) return opened;
  opened = outcome;  // closed
  if (outcome != UsbOutcome::kNoDevice) return opened;
  for (const UsbIdentity& again : bus.list(kCrazyradioVendor, kCrazyradioProduct))
    if (again.serial == identity.serial) return open_dongle(bus, again, address);
  return opened;
}

}  // namespace

std::vector<UsbIdentity> dongles_named(const std::string& name, std::vector<UsbIdentity> plugged_in) {
  if (name == "*") return plugged_in;
  if (const std::optional<std::size_t> index = index_in(name))
    return *index < plugged_in.size() ? std::vector{plugged_in[*index]} : std::vector<UsbIdentity>{};
  const auto has_name = [wanted = in_capitals(name)](const UsbIdentity& identity) {
    return in_capitals(identity.serial) == wanted;
  };
  const bool is_there = std::ranges::any_of(plugged_in, has_name);
  std::erase_if(plugged_in, [&](const UsbIdentity& identity) {
    return is_there ? !has_name(identity) : identity.access != UsbOutcome::kAccessDenied;
  });
  return plugged_in;
}

std::variant<Crazyradio, UsbOutcome> Crazyradio::open(UsbBus& bus, const RadioAddress& address) {
  std::optional<UsbOutcome> failure;
  for (const UsbIdentity& identity :
       dongles_named(address.dongle, bus.list(kCrazyradioVendor, kCrazyradioProduct))) {
    std::variant<Crazyradio, UsbOutcome> opened = open(bus, identity, address);
    if (opened.index() == 0) return opened;
    if (!failure) failure = std::get<UsbOutcome>(opened);
  }
  return failure.value_or(UsbOutcome::kNoDevice);
}

std::variant<Crazyradio, UsbOutcome> Crazyradio::open(UsbBus& bus, const UsbIdentity& identity,
                                                      const RadioAddress& address) {
  Opened opened = open_and_reset(bus, identity, address);
  if (opened.index() == 1) return std::get<UsbOutcome>(opened);
  Crazyradio radio(std::get<0>(std::move(opened)), identity);
  const UsbOutcome outcome = radio.initialise(address);
  if (outcome != UsbOutcome::kDone) return outcome;
  return radio;
}

UsbOutcome Crazyradio::initialise(const RadioAddress& address) {
  UsbOutcome outcome = leave_modes();
  if (outcome == UsbOutcome::kDone) outcome = set_rate(address.rate);
  if (outcome == UsbOutcome::kDone) outcome = set_channel(address.channel);
  if (outcome == UsbOutcome::kDone) outcome = request(kSetCarrier, 0);
  if (outcome == UsbOutcome::kDone) outcome = set_address(address.address);
  if (outcome == UsbOutcome::kDone) outcome = request(kSetPower, kFullPower);
  if (outcome == UsbOutcome::kDone) outcome = set_retries(kUsualRetries);
  if (outcome == UsbOutcome::kDone) outcome = request(kSetRetryDelay, kDelayFor32Bytes);
  if (outcome == UsbOutcome::kDone) outcome = request(kSetAcknowledge, 1);
  if (outcome == UsbOutcome::kDone) outcome = drain(kQuiet).outcome;
  return outcome;
}

/// Another program may have left it in one of them, and a reset does not end them: Crazyradio 2.0 listens to
/// others or drops packets on purpose, PA does not send. Firmware that has no such mode stalls the request.
UsbOutcome Crazyradio::leave_modes() {
  const auto known = [](UsbOutcome outcome) {
    return outcome == UsbOutcome::kStall ? UsbOutcome::kDone : outcome;
  };
  if (!is_crazyradio_2_) return known(request(kSetModeOfPa, 0));
  constexpr std::array<std::uint8_t, 2> kNoLoss{0, 0};
  const UsbOutcome outcome = known(request(kSetRadioModeOf2, 0));
  return outcome == UsbOutcome::kDone ? known(request(kSimulateLossOf2, 0, kNoLoss)) : outcome;
}

UsbOutcome Crazyradio::request(std::uint8_t request, std::uint16_t value,
                               std::span<const std::uint8_t> data) {
  return device_->control_out(request, value, 0, data, kUsbControlTimeout).outcome;
}

UsbOutcome Crazyradio::set_rate(RadioRate rate) {
  SWIFTLET_CHECK(rate >= range().slowest, "the dongle has that data rate");
  if (rate_ == rate) return UsbOutcome::kDone;
  const UsbOutcome outcome = request(kSetRate, static_cast<std::uint16_t>(rate));
  if (outcome == UsbOutcome::kDone) rate_ = rate;
  return outcome;
}

UsbOutcome Crazyradio::set_channel(std::uint8_t channel) {
  SWIFTLET_CHECK(channel <= range().last_channel, "the dongle has that channel");
  if (channel_ == channel) return UsbOutcome::kDone;
  const UsbOutcome outcome = request(kSetChannel, channel);
  if (outcome == UsbOutcome::kDone) channel_ = channel;
  return outcome;
}

UsbOutcome Crazyradio::set_address(const std::array<std::uint8_t, 5>& address) {
  if (address_ == address) return UsbOutcome::kDone;
  const UsbOutcome outcome = request(kSetAddress, 0, address);
  if (outcome == UsbOutcome::kDone) address_ = address;
  return outcome;
}

UsbOutcome Crazyradio::set_retries(std::uint8_t retries) {
  SWIFTLET_CHECK(retries <= 15, "the dongle retries up to 15 times");
  if (retries_ == retries) return UsbOutcome::kDone;
  const UsbOutcome outcome = request(kSetRetries, retries);
  if (outcome == UsbOutcome::kDone) retries_ = retries;
  return outcome;
}

RadioAnswer Crazyradio::exchange(std::span<const std::uint8_t> packet) {
  SWIFTLET_CHECK(!packet.empty() && packet.size() <= kMaxRadioPayload, "a radio packet has 1 to 32 bytes");
  if (!answer_may_be_late_) return exchange_once(packet);
  RadioAnswer failed;
  failed.outcome = drain(kQuiet).outcome;
  if (failed.outcome != UsbOutcome::kDone) return failed;
  const RadioAnswer answer = exchange_once(packet);
  if (answer.outcome != UsbOutcome::kDone) return answer;
  // The dongle answers in order: an answer that another one follows was the late one.
  const Drained drained = drain(kLongQuiet);
  failed.outcome = drained.outcome == UsbOutcome::kDone ? UsbOutcome::kTimeout : drained.outcome;
  if (drained.outcome != UsbOutcome::kDone || drained.answers > 0) return failed;
  answer_may_be_late_ = false;
  return answer;
}

RadioAnswer Crazyradio::exchange_once(std::span<const std::uint8_t> packet) {
  RadioAnswer failed;
  const UsbTransfer out = device_->bulk_out(kDongleOut, packet, kUsbOutTimeout);
  if (!out.done()) {
    failed.outcome = recover(kDongleOut, out.outcome);
    return failed;
  }
  const UsbTransfer in = device_->bulk_in(kDongleIn, buffer_, kInTimeout);
  if (!in.done()) {
    failed.outcome = recover(kDongleIn, in.outcome);
    return failed;
  }
  return decode(in.size);
}

UsbOutcome Crazyradio::recover(std::uint8_t endpoint, UsbOutcome failure) {
  answer_may_be_late_ = true;
  if (failure != UsbOutcome::kStall) return failure;
  const UsbOutcome cleared = device_->clear_halt(endpoint);
  return cleared == UsbOutcome::kDone ? failure : cleared;
}

Crazyradio::Drained Crazyradio::drain(Duration quiet) {
  Drained drained;
  for (int i = 0; i < kMaxStaleAnswers; ++i) {
    const UsbOutcome outcome = device_->bulk_in(kDongleIn, buffer_, quiet).outcome;
    if (outcome == UsbOutcome::kTimeout) return drained;
    ++drained.answers;
    if (outcome == UsbOutcome::kDone) continue;
    drained.outcome = recover(kDongleIn, outcome);
    if (drained.outcome != UsbOutcome::kStall) return drained;
    drained.outcome = UsbOutcome::kDone;
  }
  drained.outcome = UsbOutcome::kFault;  // it sends without a request
  return drained;
}

RadioAnswer Crazyradio::decode(std::size_t size) const {
  RadioAnswer answer;
  const std::uint8_t status = size == 0 ? std::uint8_t{0} : buffer_[0];
  answer.acknowledged = (status & 0x01) != 0;
  if (!answer.acknowledged) return answer;
  answer.retries = status >> 4;
  for (std::size_t i = 1; i < size && answer.payload.try_push_back(buffer_[i]); ++i) {
  }
  return answer;
}

}  // namespace swiftlet
