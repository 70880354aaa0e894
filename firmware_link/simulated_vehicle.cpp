// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "firmware_link/simulated_vehicle.hpp"

#include <algorithm>
#include <cmath>
#include <string_view>
#include <utility>

namespace swiftlet {
namespace {

constexpr std::chrono::milliseconds kTick{1};
constexpr std::chrono::milliseconds kBooted{4000};  // on its clock when the simulation begins
constexpr double kGravity = 9.81;                   // m/s^2

constexpr double kCeilingM = 2.6;
constexpr double kRangeDownSigmaM = 0.003;
constexpr double kRssiDb = 42.0;
constexpr double kRssiSigmaDb = 1.5;

// A 250 mAh cell: 4.15 V at rest, 0.3 V less under load, eight minutes of flight, a knee at the end.
constexpr double kFullV = 4.15;
constexpr double kLoadV = 0.3;
constexpr double kSagV = 0.5;
constexpr double kKneeV = 0.35;
constexpr double kLowV = 3.2;
constexpr double kEnduranceS = 480.0;
constexpr double kBatterySigmaV = 0.008;

constexpr std::uint8_t kPortMask = 0xF3;  // the link bits of a header carry no address
constexpr std::uint8_t kEcho = 0xF0;
constexpr std::uint8_t kSource = 0xF1;
constexpr std::uint8_t kVersion = 0xD1;
constexpr unsigned kLogPort = 5;
constexpr std::uint8_t kProtocolVersion = 12;

PacketBytes packet_of(std::span<const std::uint8_t> head, std::string_view text = {}) {
  PacketBytes packet;
  for (const std::uint8_t byte : head) SWIFTLET_CHECK(packet.try_push_back(byte), "a packet has 31 bytes");
  for (const char c : text)
    SWIFTLET_CHECK(packet.try_push_back(static_cast<std::uint8_t>(c)), "a packet has 31 bytes");
  return packet;
}

PacketBytes link_source(std::uint8_t header) {
  PacketBytes packet = packet_of(std::array{header}, "Bitcraze Crazyflie");
  while (packet.try_push_back(0)) continue;
  return packet;
}

std::vector<PacketBytes> answer_version(std::span<const std::uint8_t> packet) {
  if (packet.size() < 2) return {};
  const std::array<std::uint8_t, 2> head{packet[0], packet[1]};
  switch (packet[1]) {
    case 0:
      return {packet_of(std::array<std::uint8_t, 6>{packet[0], 0, kProtocolVersion, 0, 0, 0})};
    case 1:
      return {packet_of(head, "swiftlet simulation")};
    case 2:
      return {packet_of(head, "Crazyflie 2.1")};
    default:
      return {};
  }
}

}  // namespace

SimulatedVehicle::SimulatedVehicle(SimulatedWorld world, const VehicleModel& model, std::uint64_t seed)
    : world_(std::move(world)),
      model_(model),
      flight_(fly(world_, model.pilot, seed)),
      odometry_(model.odometry, seed),
      rangers_{{{0.0, &VehicleState::front_mm, NoiseSource(seed, "range_front")},
                {kPi, &VehicleState::back_mm, NoiseSource(seed, "range_back")},
                {kPi / 2.0, &VehicleState::left_mm, NoiseSource(seed, "range_left")},
                {-kPi / 2.0, &VehicleState::right_mm, NoiseSource(seed, "range_right")}}},
      up_noise_(seed, "range_up"),
      down_noise_(seed, "range_down"),
      battery_noise_(seed, "battery"),
      rssi_noise_(seed, "rssi"),
      log_(seed),
      now_(kBooted) {
  const double phase = NoiseSource(seed, "range_phase").uniform(0.0, 1.0);
  next_range_read_ = now_ + std::chrono::duration_cast<Milliseconds>(phase * model_.range_period);
  show(flight_.front());
}

double SimulatedVehicle::progress() const {
  return static_cast<double>(flight_index(now_)) / static_cast<double>(flight_.size() - 1);
}

bool SimulatedVehicle::is_finished() const { return flight_index(now_) + 1 == flight_.size(); }

std::size_t SimulatedVehicle::flight_index(Duration since_boot) const {
  if (!took_off_at_ || since_boot <= *took_off_at_) return 0;
  const auto steps = static_cast<std::size_t>((since_boot - *took_off_at_) / kFlightStep);
  return std::min(steps, flight_.size() - 1);
}

Pose2 SimulatedVehicle::T_world_body(DeviceTime at) const {
  const Duration since_boot = at.time_since_epoch();
  const std::size_t i = flight_index(since_boot);
  const Pose2& before = flight_[i].T_world_body;
  if (i + 1 == flight_.size() || !took_off_at_ || since_boot <= *took_off_at_) return before;
  const Pose2& after = flight_[i + 1].T_world_body;
  const Duration past = since_boot - *took_off_at_ - static_cast<std::int64_t>(i) * kFlightStep;
  const double share = to_seconds(past) / to_seconds(kFlightStep);
  return {before.x_m() + share * (after.x_m() - before.x_m()),
          before.y_m() + share * (after.y_m() - before.y_m()),
          before.yaw_rad() + share * wrap_angle(after.yaw_rad() - before.yaw_rad())};
}

std::vector<PacketBytes> SimulatedVehicle::handle(std::span<const std::uint8_t> packet) {
  if (packet.empty() || packet.size() > PacketBytes::capacity()) return {};
  switch (packet[0] & kPortMask) {
    case kEcho:
      return {packet_of(packet)};
    case kSource:
      return {link_source(packet[0])};
    case kVersion:
      return answer_version(packet);
    default:
      break;
  }
  if (packet[0] >> 4U != kLogPort) return {};
  const std::optional<PacketBytes> answer = log_.handle(packet, now_);
  if (!took_off_at_ && log_.has_running_block()) took_off_at_ = now_;
  return answer ? std::vector<PacketBytes>{*answer} : std::vector<PacketBytes>{};
}

std::vector<SentPacket> SimulatedVehicle::advance(DeviceTime to) {
  std::vector<SentPacket> sent;
  while (now() + kTick <= to) {
    tick();
    for (const PacketBytes& bytes : log_.sample(now_, state_)) sent.push_back({now(), bytes});
  }
  return sent;
}

/// One millisecond of the firmware's life.
void SimulatedVehicle::tick() {
  now_ += kTick;
  if (took_off_at_ && (now_ - *took_off_at_) % kFlightStep == Duration(0)) fly_on();
  if (now_ >= next_range_read_) {
    read_rangers();
    update_battery();
    next_range_read_ += std::chrono::duration_cast<Milliseconds>(model_.range_period);
  }
}

void SimulatedVehicle::fly_on() {
  const FlightState& truth = flight_[flight_index(now_)];
  odometry_.step(truth);
  show(truth);
}

void SimulatedVehicle::show(const FlightState& truth) {
  state_.x_m = odometry_.T_odom_body().x_m();
  state_.y_m = odometry_.T_odom_body().y_m();
  state_.yaw_rad = odometry_.T_odom_body().yaw_rad();
  state_.z_m = truth.height_m;
  state_.vx_body_m_s = odometry_.vx_body_m_s();
  state_.vy_body_m_s = odometry_.vy_body_m_s();
  state_.yaw_rate_rad_s = odometry_.yaw_rate_rad_s();
  state_.ax_body_m_s2 = truth.ax_body_m_s2;
  state_.ay_body_m_s2 = truth.ay_body_m_s2;
  state_.roll_rad = std::atan(-truth.ay_body_m_s2 / kGravity);
  state_.pitch_rad = std::atan(truth.ax_body_m_s2 / kGravity);
  state_.position_variance_m2 = odometry_.position_variance_m2();
  state_.yaw_variance_rad2 = odometry_.yaw_variance_rad2();
  state_.is_flying = truth.height_m > 0.0;
}

/// Publishes what each sensor measured since it was last restarted.
void SimulatedVehicle::read_rangers() {
  const Pose2 T_world_body_then = T_world_body(now() - model_.range_age);
  for (Ranger& ranger : rangers_) {
    const double direction_rad = T_world_body_then.yaw_rad() + ranger.bearing_rad;
    state_.*ranger.shown_mm = logged_range_mm(measure_range(world_.walls, T_world_body_then.position(),
                                                            direction_rad, model_.ranger, ranger.noise));
  }
  const double up_m = kCeilingM - state_.z_m;
  const double up_sigma_m = model_.ranger.noise_floor_m + model_.ranger.noise_share * up_m;
  state_.up_mm = logged_range_mm(up_m + up_noise_.gaussian(up_sigma_m));
  state_.down_mm = logged_range_mm(std::max(0.0, state_.z_m + down_noise_.gaussian(kRangeDownSigmaM)));
  state_.rssi_db = kRssiDb + rssi_noise_.gaussian(kRssiSigmaDb);
}

void SimulatedVehicle::update_battery() {
  const double flown_s = to_seconds(static_cast<std::int64_t>(flight_index(now_)) * kFlightStep);
  const double used = std::min(1.0, flown_s / kEnduranceS);
  const double load_v = state_.is_flying ? kLoadV : 0.0;
  state_.battery_v = kFullV - load_v - kSagV * used - kKneeV * std::pow(used, 12.0) +
                     battery_noise_.gaussian(kBatterySigmaV);
  state_.battery_percent = 100.0 * (1.0 - used);
  state_.battery_is_low = state_.battery_v < kLowV;
}

}  // namespace swiftlet
