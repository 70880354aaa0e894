// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "firmware_link/simulation/link.hpp"

#include <array>
#include <string>
#include <utility>

#include "firmware_link/link/link_packet.hpp"
#include "firmware_link/simulation/sensor_errors.hpp"

namespace swiftlet {
namespace {

constexpr HostTime kOpened{std::chrono::seconds(1'767'225'600)};  // 2026-01-01 00:00:00 UTC
constexpr std::chrono::milliseconds kStep{1};
constexpr std::chrono::milliseconds kPollEvery{20};

VehicleModel on_air(VehicleModel model) {
  model.link_timeout = kRadioLinkTimeout;
  return model;
}

}  // namespace

Result<std::unique_ptr<SimulatedLink>> SimulatedLink::open(std::string_view world, std::uint64_t seed,
                                                           int laps, const SparedErrors& spared) {
  Result<SimulatedWorld> made = make_simulated_world(world, seed);
  if (!made) return made.error();
  VehicleModel model = vehicle_model_in(*made, seed);
  spared.take_from(model);
  model.pilot.laps = laps;
  model.battery_endurance *= RepeatedScript(made->flight, laps).passes();
  return std::make_unique<SimulatedLink>(std::move(*made), model, kPacketLoss, seed);
}

SimulatedLink::SimulatedLink(SimulatedWorld world, const VehicleModel& model, double packet_loss,
                             std::uint64_t seed)
    : vehicle_(std::move(world), on_air(model), seed),
      loss_noise_(seed, "packet_loss"),
      packet_loss_(packet_loss),
      opened_at_(vehicle_.now()),
      polled_at_(opened_at_) {}

Result<LinkFrame> SimulatedLink::receive(Duration timeout) {
  const DeviceTime asked_at = vehicle_.now();
  while (received_.empty()) {
    if (vehicle_.is_finished()) return Error{ErrorCode::kEndOfRecording, "the simulated flight is over"};
    if (vehicle_.now() - asked_at + kStep > timeout) return Error{ErrorCode::kTimeout, "no packet"};
    for (const SentPacket& sent : vehicle_.advance(vehicle_.now() + kStep)) {
      const bool is_log_data = is_on(bytes_of(sent.bytes), kLogDataTopic);
      if (is_log_data && loss_noise_.chance(packet_loss_)) continue;
      queue(LinkDirection::kFromVehicle, sent.at, bytes_of(sent.bytes));
    }
    poll();
  }
  const LinkFrame frame = received_.front();
  received_.pop_front();
  return frame;
}

Status SimulatedLink::send(std::span<const std::uint8_t> packet) {
  if (packet.empty() || packet.size() > PacketBytes::capacity())
    return Error{ErrorCode::kInvalidInput,
                 "a packet of " + std::to_string(packet.size()) + " bytes; CRTP takes 1 to 31"};
  queue(LinkDirection::kToVehicle, vehicle_.now(), packet);
  for (const PacketBytes& answer : vehicle_.handle(packet))
    queue(LinkDirection::kFromVehicle, vehicle_.now(), {answer.data(), answer.size()});
  return {};
}

/// Null packets are not delivered: there are too many.
void SimulatedLink::poll() {
  if (vehicle_.now() - polled_at_ < kPollEvery) return;
  constexpr std::array<std::uint8_t, 1> kNullPacket{0xFF};
  static_cast<void>(vehicle_.handle(kNullPacket));  // it has no answer
  polled_at_ = vehicle_.now();
}

void SimulatedLink::queue(LinkDirection direction, DeviceTime at, std::span<const std::uint8_t> packet) {
  received_.push_back(frame_of(direction, host_time(at), packet));
}

HostTime SimulatedLink::host_time(DeviceTime at) const { return kOpened + (at - opened_at_); }

}  // namespace swiftlet
