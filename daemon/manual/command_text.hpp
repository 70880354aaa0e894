// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <map>
#include <string>
#include <vector>

namespace swiftlet {

/// The text of --help on an option or a positional argument.
struct OptionText {
  std::vector<std::string> names;  ///< "-o", "--output"; of an argument: its placeholder, "INPUT"
  std::string value;               ///< placeholder of what follows, "TEXT"; empty: nothing does
  std::string limits;              ///< of the value, "NUMBER from 0 to 100"; empty: none
  bool value_may_be_left_out = false;
  bool may_be_repeated = false;
  bool is_required = false;
  std::string default_value;
  std::string environment;             ///< variable that sets it, too
  std::vector<std::string> excludes;   ///< names
  std::vector<std::string> needs;      ///< names
  std::string description;             ///< may have several lines
  std::vector<std::string> choices{};  ///< all values there are; empty: many
};

/// The text of --help on a program, or on one of its commands.
struct CommandText {
  std::string name;
  std::string description;
  std::string footer;
  std::vector<OptionText> arguments;
  std::vector<OptionText> options;
  std::vector<CommandText> commands;
};

/// What a manual page has beyond --help.
struct ManualFacts {
  int section = 1;                              ///< of the manual
  std::string version;                          ///< as --version prints it
  std::map<std::string, std::string> sections;  ///< title, "FILES", and text; shown in the order of titles
  /// The values of an option, by its long name; of an argument, by its placeholder.
  std::map<std::string, std::vector<std::string>> choices;
};

/// The synopsis without program: "[OPTION]... INPUT".
[[nodiscard]] std::string synopsis_of(const CommandText& command);

}  // namespace swiftlet
