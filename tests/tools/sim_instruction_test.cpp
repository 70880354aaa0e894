// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "tools/sim_instruction.hpp"

#include <gmock/gmock.h>

#include <string>

namespace swiftlet {
namespace {

using testing::HasSubstr;
using Kind = SimInstruction::Kind;

SimInstruction parsed(std::string_view line) {
  const Result<SimInstruction> instruction = parse_sim_instruction(line);
  EXPECT_TRUE(instruction.ok()) << line;
  return instruction.ok() ? *instruction : SimInstruction{};
}

std::string refusal(std::string_view line) {
  const Result<SimInstruction> instruction = parse_sim_instruction(line);
  return instruction.ok() ? "accepted" : instruction.error().message;
}

TEST(SimInstruction, IsAWordWithOrWithoutAValue) {
  EXPECT_EQ(parsed("reboot").kind, Kind::kReboot);
  EXPECT_EQ(parsed("  reset-estimator ").kind, Kind::kResetEstimator);
  EXPECT_EQ(parsed("help").kind, Kind::kHelp);
  EXPECT_EQ(parsed("quit").kind, Kind::kQuit);
  EXPECT_EQ(parsed("silence 3").kind, Kind::kSilence);
  EXPECT_EQ(parsed("silence 3").duration, std::chrono::seconds(3));
  EXPECT_EQ(parsed("freeze 0.5").duration, std::chrono::milliseconds(500));
  EXPECT_EQ(parsed("delay 20").duration, std::chrono::milliseconds(20));
  EXPECT_EQ(parsed("loss 20").share, 0.2);
  EXPECT_EQ(parsed("duplicates 100").share, 1.0);
  EXPECT_EQ(parsed("unplug-deck multiranger").deck, SimulatedDeck::kMultiranger);
}

TEST(SimInstruction, MayBeAnEmptyLine) {
  EXPECT_EQ(parsed("").kind, Kind::kNothing);
  EXPECT_EQ(parsed(" \t\r").kind, Kind::kNothing);
}

TEST(SimInstruction, IsRefusedWithItsSyntax) {
  EXPECT_THAT(refusal("explode"), HasSubstr("explode"));
  EXPECT_THAT(refusal("reboot now"), HasSubstr("stands alone"));
  EXPECT_THAT(refusal("loss"), HasSubstr("one value"));
  EXPECT_THAT(refusal("loss 1 2"), HasSubstr("one value"));
  EXPECT_THAT(refusal("loss 101"), HasSubstr("100 percent"));
  EXPECT_THAT(refusal("silence -1"), HasSubstr("seconds"));
  EXPECT_THAT(refusal("delay 5ms"), HasSubstr("milliseconds"));
  EXPECT_THAT(refusal("freeze nan"), HasSubstr("seconds"));
  EXPECT_THAT(refusal("unplug-deck lighthouse"), HasSubstr("multiranger"));
}

TEST(SimInstruction, IsListedInTheHelp) {
  for (const char* word : {"reboot", "silence", "freeze", "reset-estimator", "loss", "delay", "duplicates",
                           "unplug-deck", "help", "quit"})
    EXPECT_THAT(std::string(sim_instructions_help()), HasSubstr(word));
}

}  // namespace
}  // namespace swiftlet
