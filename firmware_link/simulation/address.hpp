// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "core/base/result.hpp"

namespace swiftlet {

/// Which simulated flight: what a sim:// URI names.
struct SimulationAddress {
  std::string world;
  std::uint64_t seed = 1;
  int laps = 1;  ///< how often the world's script is flown
};

/// `WORLD[?seed=N&laps=N]`. Error: kInvalidInput: what is wrong. Does not check that the world exists.
[[nodiscard]] Result<SimulationAddress> parse_simulation_address(std::string_view text);

}  // namespace swiftlet
