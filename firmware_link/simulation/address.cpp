// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "firmware_link/simulation/address.hpp"

#include <limits>
#include <utility>

#include "firmware_link/link/uri_text.hpp"
#include "firmware_link/simulation/flight.hpp"

namespace swiftlet {
namespace {

Status apply(const UriParameter& parameter, SimulationAddress& address) {
  if (parameter.key == "seed") {
    const Result<std::uint64_t> seed = parse_seed(parameter.value);
    if (!seed) return seed.error();
    address.seed = *seed;
    return {};
  }
  if (parameter.key == "fault") {
    Result<std::vector<MotionFault>> faults = parse_motion_faults(parameter.value);
    if (!faults) return faults.error();
    address.faults = std::move(faults).value();
    return {};
  }
  if (parameter.key == "without") {
    const Result<SparedErrors> spared = SparedErrors::parse(parameter.value);
    if (!spared) return spared.error();
    address.spared = *spared;
    return {};
  }
  if (parameter.key != "laps") return unknown_parameter(parameter.key, "seed, laps, fault, without");
  const auto laps = whole_number(parameter.value, 1, kMaxLaps);
  if (!laps) return bad_address("the laps must be a whole number from 1 to " + std::to_string(kMaxLaps));
  address.laps = *laps;
  return {};
}

}  // namespace

Result<std::uint64_t> parse_seed(std::string_view text) {
  constexpr std::uint64_t kMax = std::numeric_limits<std::uint64_t>::max();
  if (const auto seed = whole_number(text, std::uint64_t{0}, kMax)) return *seed;
  return bad_address("the seed must be a whole number from 0 to 18446744073709551615");
}

Result<SimulationAddress> parse_simulation_address(std::string_view text) {
  const Result<std::vector<UriParameter>> parameters = take_parameters(text);
  if (!parameters) return parameters.error();
  SimulationAddress address;
  address.world = text;
  if (address.world.empty()) return bad_address("names no world");
  for (const UriParameter& parameter : *parameters)
    if (const Status applied = apply(parameter, address); !applied) return applied.error();
  return address;
}

}  // namespace swiftlet
