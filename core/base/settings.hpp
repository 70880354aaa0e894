// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <array>
#include <charconv>
#include <cmath>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

namespace swiftlet {

// A configuration struct stands for one section of a configuration file. It has its SettingsSection as
// `kSection` and the Setting of each of its members as `kSettings`; a member's default is its initialiser.

/// How a section is named and introduced in the reference page.
struct SettingsSection {
  std::string_view name;
  std::string_view text;
};

/// One key of a section: a member of `Config`.
template <typename Config>
struct Setting {
  std::string_view key;
  std::variant<bool Config::*, int Config::*, double Config::*, std::optional<double> Config::*,
               std::string Config::*>
      member;
  std::string_view unit;  ///< empty where there is none
  std::string_view text;
  double lowest = 0.0;  ///< the range of numbers; both ends are within
  double highest = 0.0;
};

/// With the fewest digits that give the same number back.
inline std::string shortest_text(double value) {
  const double size = std::abs(value);
  const bool is_fixed = size == 0.0 || (size >= 1e-4 && size < 1e16);
  std::array<char, 32> text{};
  const auto end = std::to_chars(text.begin(), text.end(), value,
                                 is_fixed ? std::chars_format::fixed : std::chars_format::scientific);
  return {text.begin(), end.ptr};
}

/// The value that a range bounds; none of flags, texts and what is not set.
template <typename Value>
std::optional<double> bounded_number(const Value& value) {
  if constexpr (std::is_same_v<Value, bool> || std::is_same_v<Value, std::string>) {
    return std::nullopt;
  } else {
    return value;
  }
}

/// "section.key = value: must lie between lowest and highest"; empty where it does.
template <typename Config>
std::string setting_problem(const Config& config, const Setting<Config>& setting) {
  const std::optional<double> number =
      std::visit([&config](auto member) { return bounded_number(config.*member); }, setting.member);
  if (!number || (*number >= setting.lowest && *number <= setting.highest)) return {};
  return std::string(Config::kSection.name) + "." + std::string(setting.key) + " = " +
         shortest_text(*number) + ": must lie between " + shortest_text(setting.lowest) + " and " +
         shortest_text(setting.highest);
}

/// All settings out of their range, one line each.
template <typename Config>
std::vector<std::string> setting_problems(const Config& config) {
  std::vector<std::string> problems;
  for (const Setting<Config>& setting : Config::kSettings)
    if (std::string problem = setting_problem(config, setting); !problem.empty())
      problems.push_back(std::move(problem));
  return problems;
}

}  // namespace swiftlet
