// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "firmware_link/simulated_vehicle.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

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

std::uint8_t id_of(std::string_view group, std::string_view name) {
  const auto table = simulated_log_table();
  for (std::size_t i = 0; i < table.size(); ++i)
    if (table[i].group == group && table[i].name == name) return static_cast<std::uint8_t>(i);
  ADD_FAILURE() << "no variable " << group << "." << name;
  return 0;
}

std::vector<Bytes> ask(SimulatedVehicle& vehicle, const Bytes& packet) {
  std::vector<Bytes> answers;
  for (const PacketBytes& answer : vehicle.handle(packet)) answers.emplace_back(answer.begin(), answer.end());
  return answers;
}

/// Logs one variable as int16 every 100 ms under block 1.
void log_as_int16(SimulatedVehicle& vehicle, std::string_view group, std::string_view name) {
  const Bytes created = ask(vehicle, {0x5D, 0x06, 0x01, 0x05, id_of(group, name), 0x00}).at(0);
  ASSERT_EQ(created.back(), 0);
  const Bytes started = ask(vehicle, {0x5D, 0x03, 0x01, 0x0A}).at(0);
  ASSERT_EQ(started.back(), 0);
}
double value_of(const SentPacket& sent) {
  return static_cast<std::int16_t>(sent.bytes[5] | sent.bytes[6] << 8U);
}

DeviceTime after(const SimulatedVehicle& vehicle, double seconds) {
  return vehicle.now() + from_seconds(seconds);
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

TEST(SimulatedVehicle, TellsItsProtocolVersionAndNames) {
  SimulatedVehicle vehicle(hop(), exact(), 1);
  EXPECT_EQ(ask(vehicle, {0xDD, 0x00}), (std::vector<Bytes>{{0xDD, 0x00, 0x0C, 0x00, 0x00, 0x00}}));
  const Bytes type = ask(vehicle, {0xDD, 0x02}).at(0);
  EXPECT_EQ(std::string(type.begin() + 2, type.end()), "Crazyflie 2.1");
}

TEST(SimulatedVehicle, EchoesAndSwallowsAsTheLinkServicesDo) {
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

TEST(SimulatedVehicle, EstimatesItsPlaceFromWhereItTookOff) {
  SimulatedVehicle vehicle(hop(), exact(), 1);
  log_as_int16(vehicle, "stateEstimateZ", "x");
  for (const SentPacket& sent : vehicle.advance(after(vehicle, 12.0)))
    EXPECT_NEAR(value_of(sent) / 1000.0, vehicle.T_world_body(sent.at).x_m(), 0.012);
}

TEST(SimulatedVehicle, AnswersForTheTruthBetweenTheStepsOfItsFlight) {
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
  // Flies straight at a wall 4 m past the end, so that the reading tells when it was taken.
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

TEST(SimulatedVehicle, RunsItsBatteryDown) {
  SimulatedVehicle vehicle(make_simulated_world("loop").value(), {}, 1);
  log_as_int16(vehicle, "pm", "vbatMV");
  const std::vector<SentPacket> sent = vehicle.advance(after(vehicle, 330.0));
  EXPECT_NEAR(value_of(sent[50]), 3850.0, 60.0) << "under load";
  EXPECT_LT(value_of(sent.back()), value_of(sent[50]) - 200.0);
  EXPECT_GT(value_of(sent.back()), 3000.0);
}

TEST(SimulatedVehicle, IsTheSameInWhateverStepsTimeIsTold) {
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

}  // namespace
}  // namespace swiftlet
