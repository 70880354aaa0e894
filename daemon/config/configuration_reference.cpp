// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include <spdlog/fmt/fmt.h>

#include "daemon/config/configuration.hpp"
#include "daemon/config/tuning_range.hpp"

namespace swiftlet {
namespace {

constexpr std::string_view kIntroduction =
    R"(# Configuration

A configuration is a TOML file. Every key may be left out and has its default then; an unknown or repeated key, a
wrong type or an impossible value is refused with file and line. So are values that do not agree with each other, without
a line where the one at fault is a default. The defaults serve all places and sensors; `daemon/config/swiftletd.toml` is
a file to begin with.

This page is written by `swiftletd --print-configuration-reference`; a test keeps it up to date.
)";

constexpr const char* kTableHead =
    "\n## [{}]\n\n{}\n\n| key | type | default | unit | range | meaning |\n|---|---|---|---|---|---|\n";

std::string_view type_name(const bool&) { return "bool"; }
std::string_view type_name(const int&) { return "int"; }
std::string_view type_name(const double&) { return "real"; }
std::string_view type_name(const std::optional<double>&) { return "real"; }
std::string_view type_name(const std::string&) { return "text"; }

std::string default_text(const bool& value) { return value ? "true" : "false"; }
std::string default_text(const int& value) { return fmt::format("{}", value); }
std::string default_text(const double& value) { return fmt::format("{:.6g}", value); }
std::string default_text(const std::optional<double>&) { return "the input's"; }
std::string default_text(const std::string& value) { return fmt::format("\"{}\"", value); }

template <typename Value>
std::string range_text(const Value&, double lowest, double highest) {
  if constexpr (std::is_same_v<Value, bool> || std::is_same_v<Value, std::string>) return {};
  if constexpr (std::is_same_v<Value, int>)  // in TOML 1e+06 is no whole number
    return fmt::format("{:.0f} to {:.0f}", lowest, highest);
  return fmt::format("{:.6g} to {:.6g}", lowest, highest);
}

/// As TOML has it: a real number is never written as a whole one.
template <typename Value>
std::string number_text(const Value& value) {
  std::string text = shortest_text(static_cast<double>(value));
  if (std::is_floating_point_v<Value> && text.find_first_of(".e") == std::string::npos) text += ".0";
  return text;
}

template <typename Section>
std::string row(const Section& defaults, const Setting<Section>& setting) {
  return std::visit(
      [&](auto member) {
        const auto& value = defaults.*member;
        return fmt::format("| `{}` | {} | {} | {} | {} | {} |\n", setting.key, type_name(value),
                           default_text(value), setting.unit,
                           range_text(value, setting.lowest, setting.highest), setting.text);
      },
      setting.member);
}

}  // namespace

std::string configuration_reference() {
  std::string page(kIntroduction);
  for_each_section(Configuration(), [&page](const auto& section) {
    page += fmt::format(fmt::runtime(kTableHead), section.kSection.name, section.kSection.text);
    for (const auto& setting : section.kSettings) page += row(section, setting);
  });
  return page;
}

std::string tuning_text(const Configuration& config) {
  std::string text;
  for_each_tuning(config, [&text](std::string_view part, const auto& tuning) {
    text += fmt::format("[tuning.{}]\n", part);
    for (const auto& value : tuning.kValues) {
      const auto line = [&](auto member) {
        const TuningRange range = tuning_range(value.name, std::remove_cvref_t<decltype(tuning)>{}.*member);
        return fmt::format("{} = {}  # {} to {}\n", value.name, number_text(tuning.*member),
                           shortest_text(range.lowest), shortest_text(range.highest));
      };
      text += std::visit(line, value.member);
    }
  });
  return text;
}

}  // namespace swiftlet
