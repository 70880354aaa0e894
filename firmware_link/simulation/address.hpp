// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/result.hpp"
#include "firmware_link/simulation/motion_fault.hpp"
#include "firmware_link/simulation/spared_errors.hpp"

namespace swiftlet {

/// Which simulated flight: what a sim:// URI names.
struct SimulationAddress {
  std::string world;
  std::uint64_t seed = 1;
  int laps = 1;  ///< how often the world's script is flown
  std::vector<MotionFault> faults;
  SparedErrors spared;
};

/// N of `seed=N`. Error: kInvalidInput: it is no whole number from 0 on, or too great.
[[nodiscard]] Result<std::uint64_t> parse_seed(std::string_view text);

/// `WORLD[?seed=N&laps=N&fault=FAULTS&without=ERRORS]`, faults as in parse_motion_faults(), errors as in
/// SparedErrors::parse(). Error: kInvalidInput: what is wrong. Does not check that the world exists.
[[nodiscard]] Result<SimulationAddress> parse_simulation_address(std::string_view text);

}  // namespace swiftlet
