// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "firmware_link/session/vehicle_inventory.hpp"

#include <algorithm>
#include <array>
#include <string_view>

#include "firmware_link/crtp/byte_order.hpp"

namespace swiftlet {
namespace {

constexpr const char* kMultiranger = "deck.bcMultiranger";
// Both generations of the flow deck.
constexpr std::array<const char*, 2> kFlowDecks{"deck.bcFlow2", "deck.bcFlow"};
// Firmware does not answer a query that it does not know.
constexpr int kMaxVersionRequests = 10;

}  // namespace

VehicleInventory::VehicleInventory(TocCache& cache) : toc_(kParamTocTopic, cache) {
  ask_version(Step::kFirmware, VersionQuery::kFirmware);
}

std::optional<CrtpPacket> VehicleInventory::next_request(HostTime now) {
  const bool asks_version = step_ == Step::kFirmware || step_ == Step::kDeviceType;
  if (asks_version && request_.is_due(now) && ++version_requests_ > kMaxVersionRequests) leave_version();
  return step_ == Step::kToc ? toc_.next_request(now) : request_.take_due(now);
}

void VehicleInventory::ask_version(Step step, VersionQuery query) {
  step_ = step;
  version_requests_ = 0;
  request_.ask(version_request(query));
}

void VehicleInventory::on_frame(std::span<const std::uint8_t> packet, HostTime at) {
  request_.on_frame(packet, at);
  if (is_on(packet, kPlatformVersionTopic)) {
    if (step_ == Step::kFirmware) return on_version(packet, VersionQuery::kFirmware, firmware_);
    if (step_ == Step::kDeviceType) return on_version(packet, VersionQuery::kDeviceType, device_type_);
  }
  if (step_ == Step::kToc && is_on(packet, kParamTocTopic)) {
    toc_.on_frame(packet, at);
    if (toc_.failure()) step_ = Step::kFinished;
    if (toc_.finished()) plan_decks();
  } else if (step_ == Step::kDecks && is_on(packet, kParamReadTopic)) {
    on_deck(packet);
  }
}

void VehicleInventory::on_version(std::span<const std::uint8_t> packet, VersionQuery query,
                                  std::string& text) {
  if (packet.size() < 2 || packet[1] != static_cast<std::uint8_t>(query)) return;
  text.assign(packet.begin() + 2, std::find(packet.begin() + 2, packet.end(), std::uint8_t{0}));
  leave_version();
}

void VehicleInventory::leave_version() {
  if (step_ == Step::kFirmware) {
    ask_version(Step::kDeviceType, VersionQuery::kDeviceType);
  } else {
    step_ = Step::kToc;
  }
}

void VehicleInventory::plan_decks() {
  step_ = Step::kDecks;
  const auto plan = [this](const char* param) {
    if (const TocItem* const item = toc_.find(param)) decks_.push_back({param, item->id, {}});
  };
  plan(kMultiranger);
  for (const char* const param : kFlowDecks) plan(param);
  ask_next_deck();
}

void VehicleInventory::ask_next_deck() {
  request_.drop();
  if (deck_ == decks_.size()) {
    step_ = Step::kFinished;
  } else {
    request_.ask(param_read_request(decks_[deck_].id));
  }
}

void VehicleInventory::on_deck(std::span<const std::uint8_t> packet) {
  if (packet.size() < 4 || load_u16(packet, 1) != decks_[deck_].id) return;
  // Status, then the value; no value when the status is an error.
  if (packet[3] == 0 && packet.size() > 4) decks_[deck_].attached = packet[4] != 0;
  ++deck_;
  ask_next_deck();
}

std::optional<bool> VehicleInventory::has_multiranger() const {
  for (const Deck& deck : decks_)
    if (deck.param == std::string_view(kMultiranger)) return deck.attached;
  return std::nullopt;
}

std::optional<bool> VehicleInventory::has_flow_deck() const {
  std::optional<bool> has;
  for (const Deck& deck : decks_)
    if (deck.param != std::string_view(kMultiranger) && deck.attached)
      has = has.value_or(false) || *deck.attached;
  return has;
}

}  // namespace swiftlet
