// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "firmware_link/link/usb_cable_link.hpp"

#include <algorithm>
#include <chrono>
#include <utility>
#include <variant>

#include "firmware_link/crtp/crtp_packet.hpp"
#include "firmware_link/link/link_condition.hpp"
#include "firmware_link/link/link_packet.hpp"

namespace swiftlet {
namespace {

// The numbers are those of ST's generic serial port, which many devices have.
constexpr std::uint16_t kVendor = 0x0483;
constexpr std::uint16_t kProduct = 0x5740;
constexpr const char* kManufacturer = "Bitcraze AB";

constexpr std::uint8_t kCableOut = 0x01;
constexpr std::uint8_t kCableIn = 0x81;
// Index 2 would start the vehicle's boot loader.
constexpr std::uint8_t kSwitchRequest = 0x01;
constexpr std::uint16_t kSwitchValue = 0x01;
constexpr std::uint16_t kToUsb = 1;
constexpr std::uint16_t kToRadio = 0;

constexpr Duration kMaxRead = std::chrono::milliseconds(100);
// A client that shares the link does not wait longer for its packets to be sent.
constexpr Duration kShortestRead = std::chrono::milliseconds(1);
constexpr Duration kMaxSharedRead = std::chrono::milliseconds(2);

}  // namespace

std::vector<UsbIdentity> vehicles_on_cables(UsbBus& bus) {
  std::vector<UsbIdentity> vehicles = bus.list(kVendor, kProduct);
  std::erase_if(vehicles, [](const UsbIdentity& identity) {
    return identity.access == UsbOutcome::kDone && identity.manufacturer != kManufacturer;
  });
  return vehicles;
}

UsbCableLink::UsbCableLink(UsbBus& bus, LinkClock& clock, int index)
    : bus_(bus), clock_(clock), index_(index), received_at_(clock.now()) {
  statistics_.condition = LinkCondition::kSilent;
}

UsbCableLink::~UsbCableLink() {
  if (vehicle_)
    static_cast<void>(vehicle_->control_out(kSwitchRequest, kSwitchValue, kToRadio, {}, kUsbControlTimeout));
}

Result<LinkFrame> UsbCableLink::receive(Duration timeout) {
  const HostTime deadline = clock_.now() + timeout;
  for (;;) {
    HostTime now = clock_.now();
    watch_silence(now);
    if (!vehicle_) open(now);
    const bool something_waits = uplink_.client_waits() || uplink_.request_waits();
    // A client that sends without end must not keep what arrives waiting.
    const bool listens_first = std::exchange(has_just_sent_, false);
    if (vehicle_ && something_waits && !listens_first) {
      if (const std::optional<LinkFrame> sent = send_next(now)) return *sent;
    } else if (vehicle_) {
      const Duration longest = something_waits ? kShortestRead : deadline - now;
      if (const std::optional<LinkFrame> received = listen(longest)) return *received;
    }
    now = clock_.now();
    if (now >= deadline) return Error{ErrorCode::kTimeout, "no packet"};  // short: not on the heap
    if (!vehicle_) uplink_.sleep_for(std::min(deadline - now, ReopenSchedule::kCheckPeriod), clock_);
  }
}

Status UsbCableLink::send(std::span<const std::uint8_t> packet) { return uplink_.push(packet); }

void UsbCableLink::open(HostTime now) {
  if (!reopen_.is_due(bus_, now)) return;
  const UsbOutcome outcome = open_vehicle();
  statistics_.condition = outcome == UsbOutcome::kDone ? LinkCondition::kSilent : condition_of(outcome);
  failures_in_a_row_ = 0;
}

UsbOutcome UsbCableLink::open_vehicle() {
  const std::vector<UsbIdentity> vehicles = vehicles_on_cables(bus_);
  const UsbIdentity* const chosen = choose(vehicles);
  if (chosen == nullptr) return UsbOutcome::kNoDevice;
  if (chosen->access != UsbOutcome::kDone) return chosen->access;
  std::variant<std::unique_ptr<UsbDevice>, UsbOutcome> opened = bus_.open(*chosen, 0);
  if (const UsbOutcome* failure = std::get_if<UsbOutcome>(&opened)) return *failure;
  std::unique_ptr<UsbDevice> vehicle = std::get<0>(std::move(opened));
  const UsbOutcome outcome =
      vehicle->control_out(kSwitchRequest, kSwitchValue, kToUsb, {}, kUsbControlTimeout).outcome;
  if (outcome != UsbOutcome::kDone) return outcome;
  vehicle_ = std::move(vehicle);
  serial_ = chosen->serial;
  return outcome;
}

/// Its index changes when it or another one is plugged in. One whose texts may not be read may be it.
const UsbIdentity* UsbCableLink::choose(const std::vector<UsbIdentity>& vehicles) const {
  if (serial_.empty()) {
    const bool is_there = index_ >= 0 && std::cmp_less(index_, vehicles.size());
    return is_there ? &vehicles[static_cast<std::size_t>(index_)] : nullptr;
  }
  auto found = std::ranges::find(vehicles, serial_, &UsbIdentity::serial);
  if (found == vehicles.end())
    found = std::ranges::find(vehicles, UsbOutcome::kAccessDenied, &UsbIdentity::access);
  return found == vehicles.end() ? nullptr : &*found;
}

void UsbCableLink::lose_vehicle(UsbOutcome failure) {
  vehicle_.reset();
  ++statistics_.device_losses;
  statistics_.condition = condition_of(failure);
}

void UsbCableLink::watch_silence(HostTime now) {
  if (silent_ || now - received_at_ < kLinkSilence) return;
  silent_ = true;
  ++statistics_.silences;
  if (vehicle_)
    statistics_.condition = LinkCondition::kSilent;
  else
    uplink_.clear_requests();  // after it is plugged in again, another session begins
}

std::optional<LinkFrame> UsbCableLink::send_next(HostTime now) {
  const std::optional<UplinkQueue::Packet> packet = uplink_.next();
  if (!packet) return std::nullopt;
  if (!check(vehicle_->bulk_out(kCableOut, bytes_of(packet->bytes), kUsbOutTimeout), kCableOut))
    return std::nullopt;
  ++statistics_.packets_sent;
  ++statistics_.packets_acked;
  LinkFrame sent = frame_of(LinkDirection::kToVehicle, now, bytes_of(packet->bytes));
  sent.is_ours = packet->is_ours;
  has_just_sent_ = !packet->is_ours;
  return sent;
}

std::optional<LinkFrame> UsbCableLink::listen(Duration timeout) {
  const UsbTransfer transfer = vehicle_->bulk_in(
      kCableIn, buffer_, std::min(timeout, uplink_.is_shared() ? kMaxSharedRead : kMaxRead));
  if (transfer.outcome == UsbOutcome::kTimeout) return std::nullopt;  // it has nothing to send
  if (!check(transfer, kCableIn)) return std::nullopt;
  received_at_ = clock_.now();
  silent_ = false;
  statistics_.condition = LinkCondition::kConnected;
  const std::span<const std::uint8_t> packet(buffer_.data(), transfer.size);
  if (!has_content(packet)) return std::nullopt;
  ++statistics_.packets_received;
  return frame_of(LinkDirection::kFromVehicle, received_at_, packet);
}

bool UsbCableLink::check(UsbTransfer transfer, std::uint8_t endpoint) {
  if (transfer.done()) {
    failures_in_a_row_ = 0;
    return true;
  }
  UsbOutcome outcome = transfer.outcome;
  if (outcome == UsbOutcome::kTimeout) ++statistics_.usb_timeouts;
  if (outcome == UsbOutcome::kStall) outcome = vehicle_->clear_halt(endpoint);
  const bool goes_on = outcome == UsbOutcome::kDone || outcome == UsbOutcome::kTimeout;
  if (!goes_on || ++failures_in_a_row_ >= ReopenSchedule::kMaxFailuresInARow)
    lose_vehicle(outcome == UsbOutcome::kDone ? transfer.outcome : outcome);
  return false;
}

}  // namespace swiftlet
