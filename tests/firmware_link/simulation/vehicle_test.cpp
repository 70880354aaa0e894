// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "firmware_link/simulation/vehicle.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "firmware_link/crtp/byte_order.hpp"
#include "firmware_link/crtp/crtp_packet.hpp"
#include "tests/firmware_link/simulated_log_id.hpp"
#include "tests/support/flown_states.hpp"

namespace swiftlet {
namespace {

using Bytes = std::vector<std::uint8_t>;

/// A short hop along x, 1 m from a wall on the left, without any error but what the test asks for.
SimulatedWorld hop() { return {{{{-50.0, 1.0}, {50.0, 1.0}}}, {{{0.0, 0.0}}, {{5.0, 0.0}}}}; }

VehicleModel exact() {
  VehicleModel model;
  model.pilot.wander_m = 0.0;
  model.pilot.wander_yaw_rad = 0.0;
  model.pilot.wander_speed_share = 0.0;
  model.odometry.scale_spread = 0.0;
  model.odometry.scale_wander = 0.0;
  model.odometry.velocity_noise_m_s = 0.0;
  model.odometry.yaw_bias_min_rad_s = 0.0;
  model.odometry.yaw_bias_max_rad_s = 0.0;
  model.odometry.yaw_walk_rad_sqrt_s = 0.0;
  model.odometry.turn_scale_spread = 0.0;
  model.odometry.slips_per_s = 0.0;
  model.ranger.noise_floor_m = 0.0;
  model.ranger.noise_share = 0.0;
  model.ranger.lost_anyway = 0.0;
  return model;
}

std::vector<Bytes> ask(SimulatedVehicle& vehicle, const Bytes& packet) {
  std::vector<Bytes> answers;
  for (const PacketBytes& answer : vehicle.handle(packet)) answers.emplace_back(answer.begin(), answer.end());
  return answers;
}

/// Logs one variable every 100 ms under block 1.
void log_as(LogType type, SimulatedVehicle& vehicle, std::string_view group, std::string_view name) {
  const std::uint8_t id = low_byte(simulated_log_id(group, name));
  const Bytes created = ask(vehicle, {0x5D, 0x06, 0x01, static_cast<std::uint8_t>(type), id, 0x00}).at(0);
  ASSERT_EQ(created.back(), 0);
  const Bytes started = ask(vehicle, {0x5D, 0x03, 0x01, 0x0A}).at(0);
  ASSERT_EQ(started.back(), 0);
}
void log_as_int16(SimulatedVehicle& vehicle, std::string_view group, std::string_view name) {
  log_as(LogType::kInt16, vehicle, group, name);
}
double float_of(const SentPacket& sent) {
  return static_cast<double>(std::bit_cast<float>(load_u32({sent.bytes.data(), sent.bytes.size()}, 5)));
}
double value_of(const SentPacket& sent) {
  return static_cast<std::int16_t>(sent.bytes[5] | sent.bytes[6] << 8U);
}

DeviceTime after(const SimulatedVehicle& vehicle, double duration_s) {
  return vehicle.now() + from_seconds(duration_s);
}

TEST(SimulatedVehicle, NamesItselfAsALinkSource) {
  SimulatedVehicle vehicle(hop(), exact(), 1);
  const std::vector<Bytes> answers = ask(vehicle, {0xFD, 0x00});
  ASSERT_EQ(answers.size(), 1U);
  ASSERT_EQ(answers[0].size(), 31U);
  EXPECT_EQ(answers[0][0], 0xFD);
  EXPECT_EQ(std::string(answers[0].begin() + 1, answers[0].begin() + 19), "Bitcraze Crazyflie");
  EXPECT_EQ(answers[0][19], 0);
}

TEST(SimulatedVehicle, ReportsItsProtocolVersionAndNames) {
  SimulatedVehicle vehicle(hop(), exact(), 1);
  EXPECT_EQ(ask(vehicle, {0xDD, 0x00}), (std::vector<Bytes>{{0xDD, 0x00, 0x0C, 0x00, 0x00, 0x00}}));
  const Bytes type = ask(vehicle, {0xDD, 0x02}).at(0);
  EXPECT_EQ(std::string(type.begin() + 2, type.end()), "Crazyflie 2.1");
}

TEST(SimulatedVehicle, AnswersAsTheLinkServices) {
  SimulatedVehicle vehicle(hop(), exact(), 1);
  EXPECT_EQ(ask(vehicle, {0xFC, 0x01, 0x02}), (std::vector<Bytes>{{0xFC, 0x01, 0x02}}));
  EXPECT_TRUE(ask(vehicle, {0xFE, 0x01}).empty()) << "sink";
  EXPECT_TRUE(ask(vehicle, {0xFF}).empty()) << "null packet";
  EXPECT_TRUE(ask(vehicle, {}).empty());
}

TEST(SimulatedVehicle, WaitsOnTheGroundUntilALogBlockRuns) {
  SimulatedVehicle vehicle(hop(), exact(), 1);
  EXPECT_TRUE(vehicle.advance(after(vehicle, 60.0)).empty());
  EXPECT_EQ(vehicle.progress(), 0.0);
  log_as_int16(vehicle, "stateEstimateZ", "x");
  EXPECT_GT(vehicle.advance(after(vehicle, 5.0)).size(), 48U);
  EXPECT_GT(vehicle.progress(), 0.2);
  EXPECT_GT(vehicle.T_world_body(vehicle.now()).x_m(), 0.5);
}

TEST(SimulatedVehicle, LandsAndFinishes) {
  SimulatedVehicle vehicle(hop(), exact(), 1);
  log_as_int16(vehicle, "stateEstimateZ", "z");
  const std::vector<SentPacket> sent = vehicle.advance(after(vehicle, 30.0));
  EXPECT_TRUE(vehicle.is_finished());
  EXPECT_EQ(vehicle.progress(), 1.0);
  EXPECT_EQ(value_of(sent[50]), 500.0);
  EXPECT_EQ(value_of(sent.back()), 0.0);
}

TEST(SimulatedVehicle, EstimatesItsPositionRelativeToTheTakeOff) {
  SimulatedVehicle vehicle(hop(), exact(), 1);
  log_as_int16(vehicle, "stateEstimateZ", "x");
  const std::vector<SentPacket> all = vehicle.advance(after(vehicle, 12.0));
  ASSERT_FALSE(all.empty());
  for (const SentPacket& sent : all)
    EXPECT_NEAR(value_of(sent) / 1000.0, vehicle.T_world_body(sent.at).x_m(), 0.012);
}

TEST(SimulatedVehicle, KnowsTheTruthBetweenTheStepsOfItsFlight) {
  SimulatedVehicle vehicle(hop(), exact(), 1);
  log_as_int16(vehicle, "stateEstimateZ", "x");
  static_cast<void>(vehicle.advance(after(vehicle, 8.0)));
  const DeviceTime t = vehicle.now() - std::chrono::milliseconds(500);
  const double step_m = vehicle.T_world_body(t + kFlightStep).x_m() - vehicle.T_world_body(t).x_m();
  EXPECT_NEAR(vehicle.T_world_body(t + kFlightStep / 2).x_m(), vehicle.T_world_body(t).x_m() + step_m / 2.0,
              1e-6);
  EXPECT_NEAR(step_m, 0.005, 1e-4);
}

TEST(SimulatedVehicle, PublishesRangesThatAreBetween78And178MillisecondsOld) {
  // Flies straight at a wall 4 m past the end, so that the reading shows when it was taken.
  SimulatedWorld world{{{{6.5, -50.0}, {6.5, 50.0}}}, {{{0.0, 0.0}}, {{5.0, 0.0}}}};
  VehicleModel model = exact();
  model.ranger.half_lost_at_m = 100.0;
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    SimulatedVehicle vehicle(world, model, seed);
    log_as_int16(vehicle, "range", "front");
    int readings = 0;
    for (const SentPacket& sent : vehicle.advance(after(vehicle, 11.0))) {
      const double now_m = 6.5 - vehicle.T_world_body(sent.at).x_m();
      if (now_m > 3.3) continue;
      const double age_s = (value_of(sent) / 1000.0 - now_m) / 0.5;
      EXPECT_GT(age_s, 0.070);
      EXPECT_LT(age_s, 0.185);
      ++readings;
    }
    EXPECT_GT(readings, 10);
  }
}

TEST(SimulatedVehicle, ShowsNoRangeBeforeTheFirstMeasurement) {
  VehicleModel model = exact();
  model.range_period = std::chrono::seconds(10);
  SimulatedVehicle vehicle(hop(), model, 1);
  log_as_int16(vehicle, "range", "left");
  EXPECT_EQ(value_of(vehicle.advance(after(vehicle, 0.2)).at(0)), 0.0);
}

TEST(SimulatedVehicle, ShowsTheSentinelWithoutATarget) {
  SimulatedVehicle vehicle(hop(), exact(), 1);
  log_as_int16(vehicle, "range", "right");
  const std::vector<SentPacket> sent = vehicle.advance(after(vehicle, 1.0));
  EXPECT_EQ(value_of(sent.back()), 32766.0);
}

TEST(SimulatedVehicle, RangesInTheFourDirectionsOfItsBody) {
  // Standing at the origin, nose along x, with a wall on each side at a distance of its own.
  const SimulatedWorld room{{{{1.0, -9.0}, {1.0, 9.0}},
                             {{-1.5, -9.0}, {-1.5, 9.0}},
                             {{-9.0, 0.5}, {9.0, 0.5}},
                             {{-9.0, -0.8}, {9.0, -0.8}}},
                            {{{0.0, 0.0}}, {{0.5, 0.0}}}};
  const std::pair<const char*, double> expected_mm[] = {
      {"front", 1000.0}, {"back", 1500.0}, {"left", 500.0}, {"right", 800.0}};
  for (const auto& [name, distance_mm] : expected_mm) {
    SimulatedVehicle vehicle(room, exact(), 1);
    log_as_int16(vehicle, "range", name);
    EXPECT_NEAR(value_of(vehicle.advance(after(vehicle, 1.0)).back()), distance_mm, 1.0) << name;
  }
}

/// A corridor of 2 m below, one of 1 m above; stairs of 5 m.
SimulatedWorld two_corridors() {
  return {.walls = {{{-50.0, 1.0}, {50.0, 1.0}}, {{-50.0, -1.0}, {50.0, -1.0}}},
          .flight = {{{0.0, 0.0}},
                     {{2.0, 0.0}},
                     {.position = {7.0, 0.0}, .storey = 1},
                     {.position = {10.0, 0.0}, .storey = 1}},
          .upper_walls = {{{{-50.0, 0.5}, {50.0, 0.5}}, {{-50.0, -0.5}, {50.0, -0.5}}}}};
}

TEST(SimulatedVehicle, RangesToTheWallsOfItsStorey) {
  SimulatedVehicle vehicle(two_corridors(), exact(), 1);
  log_as_int16(vehicle, "range", "left");
  int below = 0;
  int above = 0;
  for (const SentPacket& sent : vehicle.advance(after(vehicle, 40.0))) {
    const double x_m = vehicle.T_world_body(sent.at).x_m();
    if (x_m > 4.3 && x_m < 4.7) continue;  // about the middle of the stairs
    EXPECT_NEAR(value_of(sent), x_m < 4.5 ? 1000.0 : 500.0, 60.0) << x_m;
    ++(x_m < 4.5 ? below : above);
  }
  EXPECT_GT(below, 50);
  EXPECT_GT(above, 50);
}

TEST(SimulatedVehicle, EstimatesItsHeightAboveTheGroundBelowOnStairs) {
  for (const auto& [group, name] : {std::pair("stateEstimateZ", "z"), std::pair("range", "zrange")}) {
    SimulatedVehicle vehicle(two_corridors(), exact(), 1);
    log_as_int16(vehicle, group, name);
    for (const SentPacket& sent : vehicle.advance(after(vehicle, 20.0))) {
      if (vehicle.T_world_body(sent.at).x_m() > 1.0) {
        EXPECT_NEAR(value_of(sent), 500.0, 20.0) << name;
      }
    }
  }
}

TEST(SimulatedVehicle, MeasuresAltitudeWithItsBarometer) {
  VehicleModel model = exact();
  model.barometer = {.noise_sigma_m = 0.0, .drift_sigma_m = 0.0};
  SimulatedVehicle vehicle(two_corridors(), model, 1);
  log_as_int16(vehicle, "baro", "asl");  // whole metres
  const std::vector<SentPacket> sent = vehicle.advance(after(vehicle, 60.0));
  EXPECT_TRUE(vehicle.is_finished());
  EXPECT_EQ(value_of(sent.front()), 50.0);
  EXPECT_EQ(value_of(sent.back()), 53.0);
}

TEST(SimulatedVehicle, MeasuresAltitudeToAMetreOverAFlightThroughTwoStoreys) {
  const SimulatedWorld world = make_simulated_world("storeys").value();
  const std::vector<FlightState> flight = fly(world, PilotModel{}, 1);
  SimulatedVehicle vehicle(world, {}, 1);
  log_as(LogType::kFloat, vehicle, "baro", "asl");
  const DeviceTime start = vehicle.now();
  std::optional<double> offset_m;
  for (const SentPacket& sent : vehicle.advance(after(vehicle, 420.0))) {
    const auto i = static_cast<std::size_t>((sent.at - start) / kFlightStep);
    if (i >= flight.size()) break;
    const double above_m = float_of(sent) - flight[i].height_m;
    if (!offset_m) offset_m = above_m;
    ASSERT_NEAR(above_m - *offset_m, flight[i].ground_m, 1.0) << i;
  }
  EXPECT_TRUE(vehicle.is_finished());
}

TEST(SimulatedVehicle, DischargesItsBattery) {
  SimulatedVehicle vehicle(make_simulated_world("loop").value(), {}, 1);
  log_as_int16(vehicle, "pm", "vbatMV");
  const std::vector<SentPacket> sent = vehicle.advance(after(vehicle, 330.0));
  EXPECT_NEAR(value_of(sent[50]), 3850.0, 60.0) << "under load";
  EXPECT_LT(value_of(sent.back()), value_of(sent[50]) - 200.0);
  EXPECT_GT(value_of(sent.back()), 3000.0);
}

TEST(SimulatedVehicle, IsTheSameForAnyStepsOfTime) {
  SimulatedVehicle at_once(make_simulated_world("maze").value(), {}, 4);
  SimulatedVehicle in_steps(make_simulated_world("maze").value(), {}, 4);
  log_as_int16(at_once, "stateEstimateZ", "x");
  log_as_int16(in_steps, "stateEstimateZ", "x");
  std::vector<SentPacket> collected;
  for (int i = 0; i < 3000; ++i)
    for (const SentPacket& sent : in_steps.advance(in_steps.now() + std::chrono::milliseconds(7)))
      collected.push_back(sent);
  const std::vector<SentPacket> all = at_once.advance(after(at_once, 21.0));
  ASSERT_EQ(all.size(), collected.size());
  for (std::size_t i = 0; i < all.size(); ++i) {
    EXPECT_EQ(all[i].at, collected[i].at);
    EXPECT_EQ(value_of(all[i]), value_of(collected[i]));
  }
}

/// Polls every 20 ms, as a radio does; what was sent meanwhile, packets of log block 1 only.
std::vector<SentPacket> polled(SimulatedVehicle& vehicle, double duration_s) {
  std::vector<SentPacket> data;
  const DeviceTime end = after(vehicle, duration_s);
  while (vehicle.now() < end) {
    EXPECT_TRUE(ask(vehicle, {0xFF}).empty());
    for (const SentPacket& sent : vehicle.advance(vehicle.now() + std::chrono::milliseconds(20)))
      if (sent.bytes[0] == 0x52) data.push_back(sent);
  }
  return data;
}

std::string console_text(const std::vector<SentPacket>& sent) {
  std::string text;
  for (const SentPacket& packet : sent)
    if (packet.bytes[0] == 0x00) text.append(packet.bytes.begin() + 1, packet.bytes.end());
  return text;
}

Bytes write_of(std::string_view group, std::string_view name, const Bytes& value) {
  const std::uint16_t id = simulated_param_id(group, name);
  Bytes packet;
  for (const unsigned byte : {0x2EU, id & 0xFFU, unsigned{id} >> 8U})
    packet.push_back(static_cast<std::uint8_t>(byte));
  for (const std::uint8_t byte : value) packet.push_back(byte);
  return packet;
}
std::uint8_t param_value(SimulatedVehicle& vehicle, std::string_view group, std::string_view name) {
  const std::uint16_t id = simulated_param_id(group, name);
  return ask(vehicle, {0x2D, static_cast<std::uint8_t>(id), static_cast<std::uint8_t>(id >> 8U)}).at(0).at(4);
}

VehicleModel exact_on_air() {
  VehicleModel model = exact();
  model.link_timeout = kRadioLinkTimeout;
  return model;
}

const Bytes kStart{0x5D, 0x03, 0x01, 0x0A};
const Bytes kNoSuchBlock{0x5D, 0x03, 0x01, 0x02};

TEST(SimulatedVehicle, DoesNotAnswerPacketsWithoutAService) {
  SimulatedVehicle vehicle(hop(), exact(), 1);
  for (const unsigned port : {3U, 6U, 7U, 8U, 10U})
    EXPECT_TRUE(ask(vehicle, {static_cast<std::uint8_t>(port << 4U | 0x0CU), 0, 0, 0}).empty()) << port;
}

TEST(SimulatedVehicle, DeletesItsBlocksAfterMoreThanASecondOfSilence) {
  SimulatedVehicle vehicle(hop(), exact_on_air(), 1);
  log_as_int16(vehicle, "range", "left");
  EXPECT_GE(vehicle.advance(after(vehicle, 1.0)).size(), 9U);
  EXPECT_EQ(vehicle.flushes(), 0U);
  static_cast<void>(vehicle.advance(after(vehicle, 0.001)));
  EXPECT_EQ(vehicle.flushes(), 1U);
  EXPECT_TRUE(vehicle.advance(after(vehicle, 1.0)).empty());
  EXPECT_EQ(vehicle.flushes(), 1U);
  EXPECT_EQ(ask(vehicle, kStart).at(0), kNoSuchBlock);
  static_cast<void>(vehicle.advance(after(vehicle, 1.001)));
  EXPECT_EQ(vehicle.flushes(), 2U) << "the link had begun again";
}

TEST(SimulatedVehicle, KeepsItsBlocksWhileItReceivesNullPackets) {
  SimulatedVehicle vehicle(hop(), exact_on_air(), 1);
  log_as_int16(vehicle, "range", "left");
  EXPECT_NEAR(static_cast<double>(polled(vehicle, 5.0).size()), 50.0, 1.0);
}

TEST(SimulatedVehicle, PrintsItsBootTextOnceAClientIsConnected) {
  VehicleModel model = exact();
  model.prints_boot_text = true;
  SimulatedVehicle vehicle(hop(), model, 1);
  EXPECT_TRUE(vehicle.advance(after(vehicle, 1.0)).empty());
  static_cast<void>(vehicle.handle(Bytes{0xFF}));
  EXPECT_NE(console_text(vehicle.advance(after(vehicle, 1.0))).find("2 deck(s) found\n"), std::string::npos);
}

TEST(SimulatedVehicle, ResetsBlocksParametersAndTimeWhenRebooted) {
  SimulatedVehicle vehicle(hop(), exact(), 1);
  log_as_int16(vehicle, "stateEstimateZ", "x");
  static_cast<void>(ask(vehicle, write_of("multiranger", "filterMask", {3, 0})));
  static_cast<void>(vehicle.advance(after(vehicle, 6.0)));
  const Bytes table = ask(vehicle, {0x5C, 0x03}).at(0);

  vehicle.reboot();
  EXPECT_FALSE(vehicle.is_on_air());
  EXPECT_TRUE(ask(vehicle, {0xFC, 0x01}).empty());
  EXPECT_TRUE(vehicle.advance(after(vehicle, 1.9)).empty());
  EXPECT_FALSE(vehicle.is_on_air());
  static_cast<void>(vehicle.advance(after(vehicle, 2.2)));
  EXPECT_TRUE(vehicle.is_on_air());

  EXPECT_EQ(ask(vehicle, kStart).at(0), kNoSuchBlock);
  EXPECT_EQ(ask(vehicle, {0x5C, 0x03}).at(0), table) << "the same key: the same ids";
  EXPECT_EQ(param_value(vehicle, "multiranger", "filterMask"), 1);
  log_as_int16(vehicle, "stateEstimateZ", "x");
  const std::vector<SentPacket> sent = polled(vehicle, 0.2);
  const unsigned stamp_ms = sent.at(0).bytes[2] | unsigned{sent.at(0).bytes[3]} << 8U;
  EXPECT_GT(stamp_ms, 2000U);
  EXPECT_LT(stamp_ms, 4500U);
  EXPECT_EQ(sent.at(0).bytes[4], 0);
}

TEST(SimulatedVehicle, ContinuesItsFlightFromWhereTheRebootInterruptedIt) {
  SimulatedVehicle vehicle(hop(), exact(), 1);
  log_as_int16(vehicle, "stateEstimateZ", "x");
  static_cast<void>(vehicle.advance(after(vehicle, 6.0)));
  const double interrupted_at_m = vehicle.T_world_body(vehicle.now()).x_m();
  EXPECT_TRUE(vehicle.is_flying());
  vehicle.reboot();
  static_cast<void>(vehicle.advance(after(vehicle, 10.0)));
  EXPECT_EQ(vehicle.T_world_body(vehicle.now()).x_m(), interrupted_at_m);
  EXPECT_FALSE(vehicle.is_flying());
  log_as_int16(vehicle, "stateEstimateZ", "x");
  const std::vector<SentPacket> sent = polled(vehicle, 2.0);
  const double flown_on_m = vehicle.T_world_body(sent.back().at).x_m() - interrupted_at_m;
  EXPECT_GT(flown_on_m, 0.5);
  EXPECT_NEAR(value_of(sent.back()) / 1000.0, flown_on_m, 0.012) << "the estimate restarted";
  static_cast<void>(vehicle.advance(after(vehicle, 30.0)));
  EXPECT_TRUE(vehicle.is_finished());
}

TEST(SimulatedVehicle, ShowsNoValuesOfMissingDecks) {
  VehicleModel model = exact();
  model.has_flow_deck = false;
  model.has_multiranger = false;
  SimulatedVehicle vehicle(hop(), model, 1);
  EXPECT_EQ(param_value(vehicle, "deck", "bcFlow2"), 0);
  EXPECT_EQ(param_value(vehicle, "deck", "bcMultiranger"), 0);
  EXPECT_EQ(param_value(vehicle, "stabilizer", "estimator"), 1);
  for (const auto& [group, name] : {std::pair("range", "left"), std::pair("range", "zrange"),
                                    std::pair("stateEstimateZ", "x"), std::pair("stateEstimateZ", "vx")}) {
    log_as_int16(vehicle, group, name);
    for (const SentPacket& sent : vehicle.advance(after(vehicle, 1.0)))
      EXPECT_EQ(value_of(sent), 0.0) << name;
    static_cast<void>(ask(vehicle, {0x5D, 0x05}));
  }
}

TEST(SimulatedVehicle, KeepsTheLastRangesOfAnUnpluggedDeckUntilTheReboot) {
  SimulatedVehicle vehicle(hop(), exact(), 1);
  log_as_int16(vehicle, "range", "left");
  static_cast<void>(vehicle.advance(after(vehicle, 4.0)));
  vehicle.unplug(SimulatedDeck::kMultiranger);
  const double last_mm = value_of(vehicle.advance(after(vehicle, 0.1)).back());
  EXPECT_NEAR(last_mm, 1000.0, 50.0);
  for (const SentPacket& sent : vehicle.advance(after(vehicle, 2.0))) EXPECT_EQ(value_of(sent), last_mm);
  EXPECT_EQ(param_value(vehicle, "deck", "bcMultiranger"), 1);
  vehicle.reboot();
  static_cast<void>(vehicle.advance(after(vehicle, 5.0)));
  EXPECT_EQ(param_value(vehicle, "deck", "bcMultiranger"), 0);
  log_as_int16(vehicle, "range", "left");
  EXPECT_EQ(value_of(polled(vehicle, 1.0).back()), 0.0);
}

TEST(SimulatedVehicle, FreezesAllRangesForATime) {
  const SimulatedWorld world{{{{6.0, -50.0}, {6.0, 50.0}}}, {{{0.0, 0.0}}, {{5.0, 0.0}}}};
  VehicleModel model = exact();
  model.ranger.half_lost_at_m = 100.0;
  SimulatedVehicle vehicle(world, model, 1);
  log_as_int16(vehicle, "range", "front");
  static_cast<void>(vehicle.advance(after(vehicle, 9.0)));
  vehicle.freeze_ranges(std::chrono::seconds(1));
  const std::vector<SentPacket> frozen = vehicle.advance(after(vehicle, 1.0));
  for (const SentPacket& sent : frozen) EXPECT_EQ(value_of(sent), value_of(frozen.front()));
  const std::vector<SentPacket> thawed = vehicle.advance(after(vehicle, 0.5));
  EXPECT_LT(value_of(thawed.back()), value_of(frozen.front()) - 400.0);
}

TEST(SimulatedVehicle, JumpsToTheInitialPositionWhenItsEstimatorIsReset) {
  SimulatedVehicle vehicle(hop(), exact(), 1);
  log_as_int16(vehicle, "stateEstimateZ", "x");
  static_cast<void>(ask(vehicle, write_of("kalman", "initialX", {0x00, 0x00, 0x20, 0xC1})));  // -10 m
  EXPECT_GT(value_of(vehicle.advance(after(vehicle, 6.0)).back()), 1000.0);
  vehicle.reset_estimator();
  const std::vector<SentPacket> sent = vehicle.advance(after(vehicle, 0.3));
  EXPECT_NE(console_text(sent).find("State out of bounds, resetting\n"), std::string::npos);
  EXPECT_NEAR(value_of(sent.back()), -9900.0, 150.0);
}

TEST(SimulatedVehicle, ResetsItsEstimatorByParameterAndReportsIt) {
  SimulatedVehicle vehicle(hop(), exact(), 1);
  log_as_int16(vehicle, "stateEstimateZ", "x");
  static_cast<void>(vehicle.advance(after(vehicle, 6.0)));
  static_cast<void>(ask(vehicle, write_of("kalman", "resetEstimation", {1})));
  const std::vector<SentPacket> sent = vehicle.advance(after(vehicle, 0.002));
  ASSERT_FALSE(sent.empty());
  const std::uint16_t id = simulated_param_id("kalman", "resetEstimation");
  EXPECT_EQ(Bytes(sent[0].bytes.begin(), sent[0].bytes.end()),
            (Bytes{0x23, 0x01, static_cast<std::uint8_t>(id), static_cast<std::uint8_t>(id >> 8U), 0}));
  EXPECT_LT(std::abs(value_of(polled(vehicle, 0.2).back())), 150.0);
}

TEST(SimulatedVehicle, TurnsItsEstimateTowardsTheInitialYawWhileItStands) {
  SimulatedVehicle vehicle(hop(), exact(), 1);
  static_cast<void>(ask(vehicle, write_of("kalman", "initialYaw", {0x00, 0x00, 0x80, 0x3F})));  // 1 rad
  static_cast<void>(vehicle.advance(after(vehicle, 10.0)));
  log_as_int16(vehicle, "stateEstimate", "yaw");
  EXPECT_NEAR(value_of(vehicle.advance(after(vehicle, 0.2)).at(0)), degrees(1.0 - std::exp(-1.0)), 2.0);
}

TEST(SimulatedVehicle, ShowsNoPositionWithTheComplementaryEstimator) {
  SimulatedVehicle vehicle(hop(), exact(), 1);
  EXPECT_EQ(param_value(vehicle, "stabilizer", "estimator"), 2) << "a Flow deck asks for the Kalman filter";
  static_cast<void>(ask(vehicle, write_of("stabilizer", "estimator", {1})));
  log_as_int16(vehicle, "stateEstimateZ", "x");
  EXPECT_EQ(value_of(vehicle.advance(after(vehicle, 6.0)).back()), 0.0);
}

TEST(SimulatedVehicle, ShowsInvalidRangesWhenItsFilterIsOpened) {
  SimulatedVehicle vehicle(hop(), exact(), 1);
  log_as_int16(vehicle, "range", "right");
  static_cast<void>(ask(vehicle, write_of("multiranger", "filterMask", {0x05, 0x00})));
  EXPECT_LT(value_of(vehicle.advance(after(vehicle, 1.0)).back()), 1301.0);
  static_cast<void>(ask(vehicle, write_of("multiranger", "filterMask", {0x00, 0x00})));
  EXPECT_EQ(value_of(vehicle.advance(after(vehicle, 1.0)).back()), 32766.0);
}

TEST(SimulatedVehicle, DelaysEchoesOnRequest) {
  SimulatedVehicle vehicle(hop(), exact(), 1);
  static_cast<void>(ask(vehicle, write_of("crtpsrv", "echoDelay", {30, 0})));
  EXPECT_TRUE(ask(vehicle, {0xFC, 0x07}).empty());
  EXPECT_TRUE(vehicle.advance(after(vehicle, 0.029)).empty());
  EXPECT_EQ(vehicle.advance(after(vehicle, 0.001)).size(), 1U);
}

TEST(SimulatedVehicle, StartsItsClockAtTheGivenTime) {
  VehicleModel model = exact();
  model.clock_start = std::chrono::milliseconds((1 << 24) - 50);
  SimulatedVehicle vehicle(hop(), model, 1);
  log_as_int16(vehicle, "stateEstimateZ", "x");
  const PacketBytes first = vehicle.advance(after(vehicle, 0.2)).at(0).bytes;
  EXPECT_NEAR(first[2], 50, 2) << "100 ms after the start the 24 bits have wrapped";
  EXPECT_EQ(first[3], 0);
  EXPECT_EQ(first[4], 0);
}

TEST(SimulatedVehicle, SwitchesItselfOffWithAnEmptyBatteryUntilThatIsReplaced) {
  VehicleModel model;
  model.battery_endurance = std::chrono::seconds(20);
  SimulatedVehicle vehicle(make_simulated_world("loop").value(), model, 1);
  log_as_int16(vehicle, "pm", "state");
  std::vector<double> states;
  for (const SentPacket& sent : vehicle.advance(after(vehicle, 40.0))) states.push_back(value_of(sent));
  EXPECT_EQ(states.front(), 0.0);
  EXPECT_EQ(states.back(), 3.0);
  EXPECT_FALSE(vehicle.is_on_air());
  EXPECT_TRUE(ask(vehicle, {0xFC, 0x01}).empty());
  vehicle.reboot();
  static_cast<void>(vehicle.advance(after(vehicle, 5.0)));
  EXPECT_TRUE(vehicle.is_on_air());
  log_as_int16(vehicle, "pm", "vbatMV");
  EXPECT_GT(value_of(polled(vehicle, 1.0).back()), 3700.0);
}

TEST(SimulatedVehicle, StaysWithinBoundsForAnyParameterValue) {
  for (const Bytes& value : {Bytes{0, 0, 0xC0, 0x7F}, Bytes{0, 0, 0x80, 0x7F}, Bytes{0, 0, 0x80, 0x7E}}) {
    SimulatedVehicle vehicle(hop(), exact(), 1);
    static_cast<void>(ask(vehicle, write_of("kalman", "initialX", value)));
    static_cast<void>(ask(vehicle, write_of("kalman", "initialYaw", value)));
    vehicle.reset_estimator();
    log_as(LogType::kFloat, vehicle, "stateEstimate", "x");
    EXPECT_LE(std::abs(float_of(polled(vehicle, 0.2).back())), 100.0) << "not a number is not less either";
  }
}

TEST(SimulatedVehicle, SurvivesAnyPacket) {
  SimulatedVehicle vehicle(hop(), exact_on_air(), 1);
  NoiseSource noise(1, "packets");
  const auto any = [&noise](int limit) { return static_cast<std::uint8_t>(noise.uniform(0.0, limit)); };
  std::size_t answers = 0;
  for (int i = 0; i < 20'000; ++i) {
    Bytes packet(1U + any(31), 0);
    packet[0] = any(256);
    if (packet.size() > 1) packet[1] = any(14);
    for (std::size_t k = 2; k < packet.size(); ++k)
      packet[k] = noise.chance(0.3) ? std::uint8_t{0} : any(256);
    answers += ask(vehicle, packet).size();
    static_cast<void>(vehicle.advance(after(vehicle, 0.002)));
  }
  EXPECT_GT(answers, 2000U);
}

}  // namespace
}  // namespace swiftlet
