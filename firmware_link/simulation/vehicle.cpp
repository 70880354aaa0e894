// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "firmware_link/simulation/vehicle.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "firmware_link/simulation/platform.hpp"
#include "firmware_link/simulation/vehicle_motion.hpp"

namespace swiftlet {
namespace {

constexpr std::chrono::milliseconds kTick{1};

constexpr double kCeilingM = 2.6;
constexpr double kRangeDownSigmaM = 0.003;
constexpr double kRssiDb = 42.0;
constexpr double kRssiSigmaDb = 1.5;

constexpr double kBootMinS = 2.0;
constexpr double kBootMaxS = 4.0;
constexpr double kMaxPosition = 100.0;  // m, kalman.maxPos
constexpr double kAliasMaxM = 1.3;      // readings without the status filter alias to short wrong ranges

enum Port : std::uint8_t {
  kParam = 2,
  kMemory = 4,
  kLog = 5,
  kGenericSetpoint = 7,
  kSupervisor = 9,
  kPlatform = 13,
  kLink = 15
};
constexpr std::uint8_t kComplementary = 1;  // stabilizer.estimator
constexpr std::uint8_t kKalman = 2;

/// The parameters that the simulation implements.
struct ParamIds {
  std::uint16_t flow_deck = simulated_param_id("deck", "bcFlow2");
  std::uint16_t zranger_deck = simulated_param_id("deck", "bcZRanger2");
  std::uint16_t multiranger_deck = simulated_param_id("deck", "bcMultiranger");
  std::uint16_t estimator = simulated_param_id("stabilizer", "estimator");
  std::uint16_t reset_estimation = simulated_param_id("kalman", "resetEstimation");
  std::uint16_t initial_x = simulated_param_id("kalman", "initialX");
  std::uint16_t initial_y = simulated_param_id("kalman", "initialY");
  std::uint16_t initial_yaw = simulated_param_id("kalman", "initialYaw");
  std::uint16_t filter_mask = simulated_param_id("multiranger", "filterMask");
  std::uint16_t disable_flow = simulated_param_id("motion", "disable");
  std::uint16_t low_voltage = simulated_param_id("pm", "lowVoltage");
  std::uint16_t critical_voltage = simulated_param_id("pm", "criticalLowVoltage");
  std::uint16_t echo_delay = simulated_param_id("crtpsrv", "echoDelay");
};
const ParamIds& ids() {
  static const ParamIds kIds;
  return kIds;
}

std::chrono::milliseconds whole_milliseconds(Duration duration) {
  return std::chrono::duration_cast<std::chrono::milliseconds>(duration);
}

Tilt tilt_by(const FlightState& motion) {
  return {std::atan(-motion.ay_body_m_s2 / kGravity), std::atan(motion.ax_body_m_s2 / kGravity)};
}

}  // namespace

SimulatedVehicle::SimulatedVehicle(SimulatedWorld world, const VehicleModel& model, std::uint64_t seed)
    : world_(std::move(world)),
      model_(model),
      flight_({world_, model.pilot, seed}),
      odometry_(model.odometry, seed),
      tilt_(model.tilt, seed),
      rangers_{{{0.0, &VehicleState::front_mm, NoiseSource(seed, "range_front")},
                {kPi, &VehicleState::back_mm, NoiseSource(seed, "range_back")},
                {kPi / 2.0, &VehicleState::left_mm, NoiseSource(seed, "range_left")},
                {-kPi / 2.0, &VehicleState::right_mm, NoiseSource(seed, "range_right")}}},
      up_noise_(seed, "range_up"),
      down_noise_(seed, "range_down"),
      alias_noise_(seed, "range_alias"),
      rssi_noise_(seed, "rssi"),
      boot_noise_(seed, "boot"),
      barometer_(model.barometer, whole_milliseconds(model.clock_start), seed),
      battery_(model.battery_endurance, seed),
      log_(seed),
      now_(whole_milliseconds(model.clock_start)) {
  const double phase = NoiseSource(seed, "range_phase").uniform(0.0, 1.0);
  next_range_read_ = now_ + std::chrono::duration_cast<Milliseconds>(phase * model_.range_period);
  set_up_parameters();
  if (model_.prints_boot_text) print_boot_text();
  if (model_.is_steered) steered_.emplace(flight_.state(now_).T_world_body, now_);
  show(truth());
}

Pose2 SimulatedVehicle::T_world_body(DeviceTime at) {
  const Duration since_start = at.time_since_epoch();
  return steered_ ? steered_->T_world_body(since_start) : flight_.T_world_body(since_start);
}

FlightState SimulatedVehicle::truth() {
  if (!steered_) return flight_.state(now_);
  steered_->advance(now_);
  return steered_->state();
}

std::vector<PacketBytes> SimulatedVehicle::handle(std::span<const std::uint8_t> packet) {
  if (packet.empty() || packet.size() > PacketBytes::capacity() || !is_on_air()) return {};
  is_linked_ = true;
  last_received_ = now_;
  const std::optional<PacketBytes> reply = answer(packet);
  if (log_.has_running_block() && !steered_) flight_.go(now_);
  return reply ? std::vector<PacketBytes>{*reply} : std::vector<PacketBytes>{};
}

/// Setpoints, external positions and packets without a service here are accepted without an answer.
std::optional<PacketBytes> SimulatedVehicle::answer(std::span<const std::uint8_t> packet) {
  switch (packet[0] >> 4U) {
    case kParam:
      return params_.handle(packet);
    case kMemory:
      return memories_.handle(packet);
    case kLog:
      return log_.handle(packet, clock());
    case kSupervisor:
      return answer_supervisor_service(packet, state_.is_flying);
    case kPlatform:
      return answer_platform_service(packet);
    case kLink:
      return answer_echo(packet);
    case kGenericSetpoint:
      if (const auto setpoint = read_setpoint(packet); setpoint && steered_) steered_->take(*setpoint, now_);
      return std::nullopt;
    default:
      return std::nullopt;
  }
}

/// The link service; echoes are delayed by the parameter crtpsrv.echoDelay.
std::optional<PacketBytes> SimulatedVehicle::answer_echo(std::span<const std::uint8_t> packet) {
  const Milliseconds delay(static_cast<std::int64_t>(params_.number(ids().echo_delay)));
  const std::optional<PacketBytes> reply = answer_link_service(packet);
  const bool is_echo = (packet[0] & 0x03U) == 0;
  if (!reply || !is_echo || delay.count() == 0) return reply;
  queue_.push_back({now_ + delay, *reply});
  return std::nullopt;
}

std::vector<SentPacket> SimulatedVehicle::advance(DeviceTime to) {
  std::vector<SentPacket> sent;
  while (now() + kTick <= to) {
    tick();
    if (!is_on_air()) continue;
    for (const PacketBytes& bytes : send_due()) sent.push_back({now(), bytes});
  }
  return sent;
}

/// One millisecond of the firmware.
void SimulatedVehicle::tick() {
  now_ += kTick;
  if (boots_at_ && now_ >= *boots_at_) boot();
  if (!is_on_air()) return;
  check_link();
  apply_parameters();
  const bool is_step = flight_.is_going() ? flight_.is_at_step(now_) : now_ % kFlightStep == Duration(0);
  if (is_step) move();
  if (now_ >= next_range_read_) read_sensors();
}

std::vector<PacketBytes> SimulatedVehicle::send_due() {
  std::vector<PacketBytes> packets;
  const auto first_kept =
      std::stable_partition(queue_.begin(), queue_.end(), [this](const auto& p) { return p.due <= now_; });
  std::for_each(queue_.begin(), first_kept, [&packets](const auto& p) { packets.push_back(p.bytes); });
  queue_.erase(queue_.begin(), first_kept);
  if (is_linked_)
    if (const std::optional<PacketBytes> text = console_.next()) packets.push_back(*text);
  for (const PacketBytes& data : log_.sample(clock(), state_)) packets.push_back(data);
  return packets;
}

void SimulatedVehicle::reboot() {
  flight_.halt(now_);
  log_.clear();
  console_.clear();
  flush();
  booted_at_ = now_;
  boots_at_ = now_ + whole_milliseconds(from_seconds(boot_noise_.uniform(kBootMinS, kBootMaxS)));
}

void SimulatedVehicle::boot() {
  boots_at_.reset();
  if (is_off_) battery_.replace(flown());
  is_off_ = false;
  params_.boot();
  set_up_parameters();
  state_ = {};
  begin_estimate();
  ranges_frozen_until_ = now_;
  next_range_read_ = now_ + whole_milliseconds(model_.range_period);
  show(truth());
  print_boot_text();
}

void SimulatedVehicle::set_up_parameters() {
  const double has_flow = model_.has_flow_deck ? 1.0 : 0.0;
  params_.set(ids().flow_deck, has_flow);
  params_.set(ids().zranger_deck, has_flow);
  params_.set(ids().multiranger_deck, model_.has_multiranger ? 1.0 : 0.0);
  params_.set(ids().estimator, model_.has_flow_deck ? kKalman : kComplementary);
}

void SimulatedVehicle::print_boot_text() {
  console_.print("SYS: swiftlet simulation of a Crazyflie 2.1");
  const int decks = (model_.has_flow_deck ? 1 : 0) + (model_.has_multiranger ? 1 : 0);
  console_.print("DECK_CORE: " + std::to_string(decks) + " deck(s) found");
  if (model_.has_flow_deck) console_.print("DECK_CORE: bcFlow2 [OK]");
  if (model_.has_multiranger) console_.print("DECK_CORE: bcMultiranger [OK]");
  console_.print(model_.has_flow_deck ? "ESTIMATOR: Using Kalman estimator"
                                      : "ESTIMATOR: Using complementary estimator");
  console_.print("SYS: Self test passed");
}

void SimulatedVehicle::flush() {
  queue_.clear();
  is_linked_ = false;
  ++flushes_;
}

void SimulatedVehicle::check_link() {
  const bool is_silent = model_.link_timeout > Duration(0) && now_ - last_received_ > model_.link_timeout;
  if (!is_linked_ || !is_silent) return;
  log_.clear();
  flush();
}

void SimulatedVehicle::apply_parameters() {
  if (params_.number(ids().reset_estimation) == 0.0) return;
  begin_estimate();
  queue_.push_back({now_, params_.change(ids().reset_estimation, 0.0)});
}

void SimulatedVehicle::reset_estimator() {
  if (!is_on_air()) return;
  console_.print("ESTKALMAN: State out of bounds, resetting");
  begin_estimate();
}

void SimulatedVehicle::begin_estimate() {
  odometry_.reset(Pose2(bounded(ids().initial_x), bounded(ids().initial_y), bounded(ids().initial_yaw)));
}

/// Within the filter's limits: a host may write any value.
double SimulatedVehicle::bounded(std::uint16_t param) const {
  const double value = params_.number(param);
  return std::isfinite(value) ? std::clamp(value, -kMaxPosition, kMaxPosition) : 0.0;
}

void SimulatedVehicle::freeze_ranges(Duration duration) {
  ranges_frozen_until_ = now_ + whole_milliseconds(duration);
}

void SimulatedVehicle::unplug(SimulatedDeck deck) {
  (deck == SimulatedDeck::kFlow ? model_.has_flow_deck : model_.has_multiranger) = false;
}

/// One kFlightStep of flight or standing.
void SimulatedVehicle::move() {
  const FlightState state = truth();
  tilt_.step(state.height_m > 0.0 ? tilt_by(state) : Tilt());
  odometry_.step(state, model_.has_flow_deck && params_.number(ids().disable_flow) == 0.0);
  if (state.height_m <= 0.0) odometry_.pull_yaw(bounded(ids().initial_yaw));
  barometer_.advance(now_);
  show(state);
}

void SimulatedVehicle::show(const FlightState& truth) {
  const bool has_position = params_.number(ids().estimator) != kComplementary;
  state_.x_m = has_position ? odometry_.T_odom_body().x_m() : 0.0;
  state_.y_m = has_position ? odometry_.T_odom_body().y_m() : 0.0;
  state_.yaw_rad = odometry_.T_odom_body().yaw_rad();
  state_.z_m = truth.height_m;
  state_.ground_m = truth.ground_m;
  state_.baro_error_m = barometer_.error_m();
  state_.vx_body_m_s = has_position ? odometry_.vx_body_m_s() : 0.0;
  state_.vy_body_m_s = has_position ? odometry_.vy_body_m_s() : 0.0;
  state_.yaw_rate_rad_s = odometry_.yaw_rate_rad_s();
  state_.ax_body_m_s2 = truth.ax_body_m_s2;
  state_.ay_body_m_s2 = truth.ay_body_m_s2;
  const Tilt& tilt = tilt_.now();
  state_.roll_rad = tilt.roll_rad;
  state_.pitch_rad = tilt.pitch_rad;
  state_.position_variance_m2 = odometry_.position_variance_m2();
  state_.yaw_variance_rad2 = odometry_.yaw_variance_rad2();
  state_.is_flying = truth.height_m > 0.0;
}

void SimulatedVehicle::read_sensors() {
  if (now_ >= ranges_frozen_until_) read_rangers();
  state_.rssi_db = kRssiDb + rssi_noise_.gaussian(kRssiSigmaDb);
  update_battery();
  next_range_read_ += whole_milliseconds(model_.range_period);
}

/// Publishes what each sensor measured since it was last restarted.
void SimulatedVehicle::read_rangers() {
  if (model_.has_multiranger) {
    const Pose2 T_world_body_then = T_world_body(now() - model_.range_age);
    const std::vector<WallSegment> walls =
        walls_near(world_.walls_at(state_.ground_m), T_world_body_then.position(), model_.ranger.max_range_m);
    for (Ranger& ranger : rangers_) {
      const double direction_rad = T_world_body_then.yaw_rad() + ranger.bearing_rad;
      std::optional<double> range_m =
          measure_range(walls, T_world_body_then.position(), direction_rad, model_.ranger, ranger.noise);
      range_m = tilted_range_m(range_m, ranger.bearing_rad, tilt_.before(model_.range_age), state_.z_m);
      state_.*ranger.shown_mm = filtered_range_mm(range_m);
    }
    const double up_m = kCeilingM - state_.z_m;
    const double up_sigma_m = model_.ranger.noise_floor_m + model_.ranger.noise_share * up_m;
    state_.up_mm = logged_range_mm(up_m + up_noise_.gaussian(up_sigma_m));
  }
  if (model_.has_flow_deck)
    state_.down_mm = logged_range_mm(std::max(0.0, state_.z_m + down_noise_.gaussian(kRangeDownSigmaM)));
}

/// What multiranger.filterMask lets through: bit 0 good readings, any other those that failed.
double SimulatedVehicle::filtered_range_mm(std::optional<double> range_m) {
  const auto mask = static_cast<unsigned>(params_.number(ids().filter_mask));
  if (range_m && (mask & 1U) == 0) range_m.reset();
  if (!range_m && mask > 1) range_m = alias_noise_.uniform(0.0, kAliasMaxM);
  return logged_range_mm(range_m);
}

void SimulatedVehicle::update_battery() {
  battery_.update(now_, flown(), state_.is_flying,
                  {params_.number(ids().low_voltage), params_.number(ids().critical_voltage)});
  state_.battery_v = battery_.volts();
  state_.battery_percent = battery_.percent();
  state_.battery_is_low = battery_.is_low();
  if (!battery_.is_critical()) return;
  is_off_ = true;
  flight_.halt(now_);
  log_.clear();
  console_.clear();
  flush();
}

}  // namespace swiftlet
