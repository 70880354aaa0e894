// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "firmware_link/simulation/steered_flight.hpp"

#include <algorithm>
#include <bit>

#include "core/geometry/angle.hpp"
#include "firmware_link/crtp/byte_order.hpp"
#include "firmware_link/simulation/packet.hpp"

namespace swiftlet {
namespace {

constexpr CrtpTopic kGenericSetpointTopic{7, 0};
enum SetpointType : std::uint8_t { kStop = 0, kHoverLegacy = 5, kHover = 10 };
constexpr std::size_t kHoverBytes = 2 + 4 * sizeof(float);

constexpr double kClimbM = 0.25 * kFlightStepS;  // in a step
constexpr double kSinkM = 0.5 * kFlightStepS;

double float_at(std::span<const std::uint8_t> packet, std::size_t index) {
  const std::uint64_t bits = load_little_endian(packet, 2 + 4 * index, 4);
  return static_cast<double>(std::bit_cast<float>(static_cast<std::uint32_t>(bits)));
}

}  // namespace

std::optional<HoverSetpoint> read_setpoint(std::span<const std::uint8_t> packet) {
  if (!is_on(packet, kGenericSetpointTopic) || packet.size() < 2) return std::nullopt;
  if (packet[1] == kStop) return HoverSetpoint{};
  if ((packet[1] != kHover && packet[1] != kHoverLegacy) || packet.size() != kHoverBytes) return std::nullopt;
  // The first version of it counts turns to the right.
  const double left = packet[1] == kHover ? 1.0 : -1.0;
  return HoverSetpoint{.vx_body_m_s = float_at(packet, 0),
                       .vy_body_m_s = float_at(packet, 1),
                       .yaw_rate_rad_s = left * radians(float_at(packet, 2)),
                       .height_m = float_at(packet, 3)};
}

CrtpPacket hover_packet(const HoverSetpoint& setpoint) {
  PacketBytes packet = make_crtp_packet(kGenericSetpointTopic, {kHover});
  for (const double value :
       {setpoint.vx_body_m_s, setpoint.vy_body_m_s, degrees(setpoint.yaw_rate_rad_s), setpoint.height_m})
    put_little_endian(packet, std::bit_cast<std::uint32_t>(static_cast<float>(value)), sizeof(float));
  return packet;
}

SteeredFlight::SteeredFlight(const Pose2& T_world_body, Duration now)
    : motion_(T_world_body), set_at_(now), now_(now), recent_{T_world_body} {}

void SteeredFlight::take(const HoverSetpoint& setpoint, Duration now) {
  setpoint_ = setpoint;
  set_at_ = now;
}

void SteeredFlight::advance(Duration now) {
  while (now_ + kFlightStep <= now) step();
}

void SteeredFlight::step() {
  now_ += kFlightStep;
  const Duration silence = now_ - set_at_;
  HoverSetpoint aim = setpoint_;
  if (silence > kHoverAfter) aim = {.height_m = aim.height_m};
  if (silence > kLandAfter) aim = {};
  const FlightState& state = motion_.state();
  motion_.set_height(
      std::clamp(aim.height_m, std::max(0.0, state.height_m - kSinkM), state.height_m + kClimbM));
  if (state.height_m > 0.0) {
    flown_ += kFlightStep;
    const double c = state.T_world_body.cos_yaw();
    const double s = state.T_world_body.sin_yaw();
    motion_.step(c * aim.vx_body_m_s - s * aim.vy_body_m_s, s * aim.vx_body_m_s + c * aim.vy_body_m_s,
                 aim.yaw_rate_rad_s);
  } else {
    motion_ = VehicleMotion(state.T_world_body);
  }
  recent_.push_back(motion_.state().T_world_body);
  if (static_cast<std::int64_t>(recent_.size()) > 1 + kRemembered / kFlightStep) recent_.pop_front();
}

Pose2 SteeredFlight::T_world_body(Duration at) const {
  const Duration age = std::max(now_ - at, Duration::zero());
  const auto newest = static_cast<std::int64_t>(recent_.size()) - 1;
  const std::int64_t whole = age / kFlightStep;
  if (whole >= newest) return recent_.front();
  const Pose2& after = recent_[static_cast<std::size_t>(newest - whole)];
  const Pose2& before = recent_[static_cast<std::size_t>(newest - whole - 1)];
  const double share = to_seconds(age - whole * kFlightStep) / to_seconds(kFlightStep);
  return {after.x_m() + share * (before.x_m() - after.x_m()),
          after.y_m() + share * (before.y_m() - after.y_m()),
          after.yaw_rad() + share * wrap_angle(before.yaw_rad() - after.yaw_rad())};
}

}  // namespace swiftlet
