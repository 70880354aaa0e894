// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "tools/doctor/vehicle_checks.hpp"

#include <algorithm>
#include <cctype>
#include <cstdio>
#include <string>
#include <string_view>

namespace swiftlet {
namespace {

// The first with a filter on the Multiranger's readings; before it, walls out of reach show as near ones.
constexpr std::string_view kFirstFilteringFirmware = "2022.09";
// At rest. Below the first a flight is short; below the second the vehicle itself reports low.
constexpr int kChargeSoonMv = 3700;
constexpr int kEmptyMv = 3200;

/// "2026.08", as releases are named; development builds have other texts.
bool is_release(std::string_view firmware) {
  constexpr std::size_t kLength = 7;
  if (firmware.size() < kLength || firmware[4] != '.') return false;
  return std::all_of(firmware.begin(), firmware.begin() + kLength,
                     [](unsigned char c) { return c == '.' || std::isdigit(c) != 0; });
}

Finding check_firmware(const VehicleFacts& facts) {
  const std::string protocol = "CRTP protocol " + std::to_string(facts.protocol);
  const std::string all = facts.firmware.empty() ? protocol : facts.firmware + ", " + protocol;
  if (facts.protocol == 0)
    return {Mark::kProblem, "vehicle firmware", "it does not report its version", "restart the vehicle"};
  if (facts.protocol < kOldestProtocol)
    return {Mark::kProblem, "vehicle firmware", protocol + " is too old, swiftlet needs 4",
            "update the vehicle's firmware"};
  if (facts.protocol > kNewestProtocol)
    return {Mark::kWarning, "vehicle firmware",
            all + ": newer than " + std::to_string(kNewestProtocol) + ", the newest that swiftlet supports",
            "should samples look wrong, update swiftlet"};
  if (is_release(facts.firmware) && facts.firmware < kFirstFilteringFirmware)
    return {Mark::kWarning, "vehicle firmware",
            all + ": its Multiranger shows walls out of reach as near ones",
            "update the vehicle's firmware to 2022.09 or newer"};
  return {Mark::kOk, "vehicle firmware", all, ""};
}

Finding check_log(const VehicleFacts& facts) {
  if (facts.refusal)
    return {Mark::kProblem, "log", facts.refusal->message, "update the vehicle's firmware, or restart it"};
  if (!facts.logs) return {Mark::kProblem, "log", "no log data comes", "restart the vehicle and ask again"};
  return {Mark::kOk, "log", "all variables are there and log data flows", ""};
}

Finding check_deck(const char* check, std::optional<bool> attached, const std::string& without) {
  if (attached == true) return {Mark::kOk, check, "attached", ""};
  if (attached == false)
    return {Mark::kProblem, check, "the vehicle finds none: " + without,
            "check how it is mounted, then restart the vehicle"};
  return {Mark::kWarning, check, "the vehicle does not report whether it has one",
          "look: " + without + " without"};
}

std::string volts(int millivolts) {
  char text[16];
  std::snprintf(text, sizeof text, "%.2f V", millivolts / 1000.0);
  return text;
}

Finding check_battery(const VehicleHealth& health) {
  if (!health.battery_mv) return {Mark::kSkipped, "battery", "the vehicle does not report it", ""};
  const std::string now = volts(*health.battery_mv);
  const bool is_resting = !health.is_flying.value_or(false);
  if (health.battery_is_low || *health.battery_mv < kEmptyMv)
    return {Mark::kProblem, "battery", now + ": empty", "charge it"};
  if (is_resting && *health.battery_mv < kChargeSoonMv)
    return {Mark::kWarning, "battery", now + ": enough for a short flight", "charge it first"};
  return {Mark::kOk, "battery", now, ""};
}

Finding check_motors(const VehicleHealth& health) {
  if (!health.is_flying)
    return {Mark::kSkipped, "motors", "the vehicle does not report whether it flies", ""};
  if (*health.is_flying)
    return {Mark::kWarning, "motors", "it is flying: the questions just asked have reset its log",
            "ask before take-off"};
  return {Mark::kOk, "motors", "off: carried by hand like this its yaw would be wrong (docs/flying.md)", ""};
}

}  // namespace

Findings check_vehicle(const VehicleFacts& facts) {
  return {check_firmware(facts),
          check_log(facts),
          check_deck("multiranger", facts.has_multiranger, "there are no ranges"),
          check_deck("flow deck", facts.has_flow_deck, "there is no dead reckoning"),
          check_battery(facts.health),
          check_motors(facts.health)};
}

Findings skip_vehicle(const std::string& why) {
  Findings findings;
  for (const char* check : {"vehicle firmware", "log", "multiranger", "flow deck", "battery", "motors"})
    findings.push_back({Mark::kSkipped, check, why, ""});
  return findings;
}

}  // namespace swiftlet
