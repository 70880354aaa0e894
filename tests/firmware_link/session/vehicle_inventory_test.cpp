// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "firmware_link/session/vehicle_inventory.hpp"

#include <gtest/gtest.h>

#include "tests/firmware_link/scripted_vehicle.hpp"

namespace swiftlet {
namespace {

/// Every fourth packet either way is lost.
void ask(VehicleInventory& inventory, ScriptedVehicle& vehicle) {
  int passed = 0;
  for (std::int64_t ms = 0; ms < 10'000 && !inventory.finished(); ms += 10) {
    const auto request = inventory.next_request(host_ms(ms));
    if (!request || ++passed % 4 == 0) continue;
    const auto reply = vehicle.answer(bytes_of(*request));
    if (reply && ++passed % 4 != 0) inventory.on_frame(*reply, host_ms(ms));
  }
}

TEST(VehicleInventory, ReportsFirmwareTypeAndDecks) {
  ScriptedVehicle vehicle;
  TocCache cache;
  VehicleInventory inventory(cache);
  ask(inventory, vehicle);
  ASSERT_TRUE(inventory.finished());
  EXPECT_EQ(inventory.firmware(), "2026.08");
  EXPECT_EQ(inventory.device_type(), "Crazyflie 2.1");
  EXPECT_EQ(inventory.has_multiranger(), true);
  EXPECT_EQ(inventory.has_flow_deck(), true);
}

TEST(VehicleInventory, ReportsAMissingDeck) {
  ScriptedVehicle vehicle;
  vehicle.params = {
      {"pm", "lowVoltage", 3}, {"deck", "bcFlow2", 0}, {"deck", "bcFlow", 0}, {"deck", "bcMultiranger", 0}};
  TocCache cache;
  VehicleInventory inventory(cache);
  ask(inventory, vehicle);
  ASSERT_TRUE(inventory.finished());
  EXPECT_EQ(inventory.has_multiranger(), false);
  EXPECT_EQ(inventory.has_flow_deck(), false);
}

TEST(VehicleInventory, AcceptsEitherGenerationOfTheFlowDeck) {
  ScriptedVehicle vehicle;
  vehicle.params = {{"deck", "bcFlow2", 0}, {"deck", "bcFlow", 1}};
  TocCache cache;
  VehicleInventory inventory(cache);
  ask(inventory, vehicle);
  EXPECT_EQ(inventory.has_flow_deck(), true);
  EXPECT_FALSE(inventory.has_multiranger().has_value());
}

TEST(VehicleInventory, RequestsTheDecksOfAVehicleThatDoesNotReportItsType) {
  ScriptedVehicle vehicle;
  vehicle.knows_its_type = false;
  vehicle.params = {{"deck", "bcFlow2", 0}, {"deck", "bcMultiranger", 1}};
  TocCache cache;
  VehicleInventory inventory(cache);
  ask(inventory, vehicle);
  ASSERT_TRUE(inventory.finished());
  EXPECT_EQ(inventory.firmware(), "2026.08");
  EXPECT_EQ(inventory.device_type(), "");
  EXPECT_EQ(inventory.has_multiranger(), true);
  EXPECT_EQ(inventory.has_flow_deck(), false);
}

TEST(VehicleInventory, DownloadsTheTableOfContentsOnce) {
  ScriptedVehicle vehicle;
  TocCache cache;
  VehicleInventory first(cache);
  ask(first, vehicle);
  vehicle.params[0].value = 0;
  VehicleInventory second(cache);
  int requests = 0;
  for (std::int64_t ms = 0; !second.finished() && ms < 100; ++ms) {
    if (const auto request = second.next_request(host_ms(ms))) {
      ++requests;
      second.on_frame(*vehicle.answer(bytes_of(*request)), host_ms(ms));
    }
  }
  EXPECT_EQ(requests, 2 + 1 + 2);  // versions, length and crc, decks
  EXPECT_EQ(second.has_multiranger(), false);
}

}  // namespace
}  // namespace swiftlet
