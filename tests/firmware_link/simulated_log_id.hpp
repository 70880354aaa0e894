// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <string_view>

#include "firmware_link/simulation/log_table.hpp"

namespace swiftlet {

/// The number of a variable in the simulated vehicle's table; fails the test where there is none.
inline std::uint16_t simulated_log_id(std::string_view group, std::string_view name) {
  const auto table = simulated_log_table();
  for (std::size_t i = 0; i < table.size(); ++i)
    if (table[i].group == group && table[i].name == name) return static_cast<std::uint16_t>(i);
  ADD_FAILURE() << "no variable " << group << "." << name;
  return 0;
}

}  // namespace swiftlet
