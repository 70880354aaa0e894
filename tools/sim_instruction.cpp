// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "tools/sim_instruction.hpp"

#include <array>
#include <charconv>
#include <optional>
#include <sstream>
#include <string>

namespace swiftlet {
namespace {

using Kind = SimInstruction::Kind;

enum class Argument { kNone, kSeconds, kMilliseconds, kPercent, kDeck };

struct Grammar {
  std::string_view word;
  Kind kind;
  Argument argument;
};
constexpr std::array<Grammar, 10> kGrammar{{
    {"reboot", Kind::kReboot, Argument::kNone},
    {"silence", Kind::kSilence, Argument::kSeconds},
    {"freeze", Kind::kFreeze, Argument::kSeconds},
    {"reset-estimator", Kind::kResetEstimator, Argument::kNone},
    {"loss", Kind::kLoss, Argument::kPercent},
    {"delay", Kind::kDelay, Argument::kMilliseconds},
    {"duplicates", Kind::kDuplicates, Argument::kPercent},
    {"unplug-deck", Kind::kUnplugDeck, Argument::kDeck},
    {"help", Kind::kHelp, Argument::kNone},
    {"quit", Kind::kQuit, Argument::kNone},
}};

Error refused(std::string message) { return {ErrorCode::kInvalidInput, std::move(message)}; }

std::optional<double> number_within(const std::string& text, double limit) {
  double number = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  const bool is_whole = error == std::errc() && end == text.data() + text.size();
  if (!is_whole || !(number >= 0.0 && number <= limit)) return std::nullopt;
  return number;
}

Result<SimInstruction> with_number(SimInstruction instruction, const Grammar& grammar,
                                   const std::string& text) {
  const bool is_seconds = grammar.argument == Argument::kSeconds;
  const bool is_percent = grammar.argument == Argument::kPercent;
  const double limit = is_percent ? 100.0 : is_seconds ? 3600.0 : 60'000.0;
  const std::optional<double> number = number_within(text, limit);
  if (!number)
    return refused(std::string(grammar.word) + " takes " +
                   (is_percent   ? "0 to 100 percent"
                    : is_seconds ? "0 to 3600 seconds"
                                 : "0 to 60000 milliseconds"));
  if (is_percent)
    instruction.share = *number / 100.0;
  else
    instruction.duration = from_seconds(is_seconds ? *number : *number / 1000.0);
  return instruction;
}

}  // namespace

std::string_view sim_instructions_help() {
  return "reboot               switch the vehicle off and on\n"
         "silence SECONDS      nothing passes the link\n"
         "freeze SECONDS       a range sensor hangs: all ranges keep their values\n"
         "reset-estimator      the position estimate jumps back to the start\n"
         "loss PERCENT         of packets, each way\n"
         "delay MILLISECONDS   of what the vehicle sends\n"
         "duplicates PERCENT   of what the vehicle sends\n"
         "unplug-deck DECK     flow or multiranger; gone for good at the next reboot\n"
         "help                 this list\n"
         "quit                 end the simulation\n";
}

Result<SimulatedDeck> parse_deck(std::string_view name) {
  if (name == "flow") return SimulatedDeck::kFlow;
  if (name == "multiranger") return SimulatedDeck::kMultiranger;
  return refused("no deck '" + std::string(name) + "': flow or multiranger");
}

Result<SimInstruction> parse_sim_instruction(std::string_view line) {
  std::istringstream words{std::string(line)};
  std::string word;
  if (!(words >> word)) return SimInstruction{};
  std::string argument;
  std::string surplus;
  words >> argument >> surplus;
  for (const Grammar& grammar : kGrammar) {
    if (grammar.word != word) continue;
    SimInstruction instruction{.kind = grammar.kind};
    if (argument.empty() != (grammar.argument == Argument::kNone) || !surplus.empty())
      return refused(word + (grammar.argument == Argument::kNone ? " stands alone" : " takes one value"));
    if (grammar.argument == Argument::kNone) return instruction;
    if (grammar.argument != Argument::kDeck) return with_number(instruction, grammar, argument);
    const Result<SimulatedDeck> deck = parse_deck(argument);
    if (!deck) return deck.error();
    instruction.deck = *deck;
    return instruction;
  }
  return refused("no instruction '" + word + "'; try help");
}

}  // namespace swiftlet
