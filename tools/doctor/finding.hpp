// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace swiftlet {

/// How a check came out.
enum class Mark : std::uint8_t {
  kOk,
  kWarning,  ///< one can fly, but something will be worse than need be
  kProblem,  ///< stops a flight or its map
  kSkipped,  ///< does not concern this input, or cannot be looked into before another problem is solved
};

/// What one check found; one line to the user.
struct Finding {
  Mark mark = Mark::kOk;
  std::string check;   ///< its name, the same on every run: programs go by it
  std::string found;   ///< what is
  std::string remedy;  ///< what to do; empty where nothing needs doing
};
using Findings = std::vector<Finding>;

}  // namespace swiftlet
