// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <string_view>

#include "core/base/result.hpp"
#include "firmware_link/simulation/vehicle.hpp"

namespace swiftlet {

/// An instruction of the user to a running `swiftlet sim`.
struct SimInstruction {
  enum class Kind {
    kNothing,  ///< an empty line
    kReboot,
    kSilence,  ///< duration
    kFreeze,   ///< duration
    kResetEstimator,
    kLoss,        ///< share
    kDelay,       ///< duration
    kDuplicates,  ///< share
    kUnplugDeck,  ///< deck
    kHelp,
    kQuit,
  };
  Kind kind = Kind::kNothing;
  Duration duration{0};
  double share = 0.0;
  SimulatedDeck deck = SimulatedDeck::kFlow;
};

/// All instructions, for help; several lines.
[[nodiscard]] std::string_view sim_instructions_help();

/// One line as typed. Error: kInvalidInput, with a line for the user.
[[nodiscard]] Result<SimInstruction> parse_sim_instruction(std::string_view line);

/// `flow` or `multiranger`. Error: kInvalidInput.
[[nodiscard]] Result<SimulatedDeck> parse_deck(std::string_view name);

}  // namespace swiftlet
