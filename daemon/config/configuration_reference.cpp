// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include <spdlog/fmt/fmt.h>

#include "daemon/config/configuration_fields.hpp"

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

constexpr std::string_view kTableHead =
    "\n## [{}]\n\n{}\n\n| key | type | default | unit | range | meaning |\n|---|---|---|---|---|---|\n";

std::string_view introduction_of(std::string_view section) {
  if (section == "sensor") return "What is left out comes from the kind of input: Crazyflie or laser log.";
  if (section == "frontend") return "The landmark graph: one step for each sample.";
  if (section == "backend") return "Submaps, loop closing and the pose graph.";
  if (section == "map") return "The occupancy map that is published and written.";
  if (section == "record") return "What the daemon keeps of what it hears: [recording](recording.md).";
  if (section == "realtime") return "What the daemon asks of the machine: [real time](real_time.md).";
  return "What the daemon sends and how often.";
}

struct TypeName {
  std::string_view operator()(const bool*) const { return "bool"; }
  std::string_view operator()(const int*) const { return "int"; }
  std::string_view operator()(const double*) const { return "real"; }
  std::string_view operator()(const std::optional<double>*) const { return "real"; }
  std::string_view operator()(const std::string*) const { return "text"; }
};

struct DefaultValue {
  std::string operator()(const bool* value) const { return *value ? "true" : "false"; }
  std::string operator()(const int* value) const { return fmt::format("{}", *value); }
  std::string operator()(const double* value) const { return fmt::format("{:.6g}", *value); }
  std::string operator()(const std::optional<double>*) const { return "the input's"; }
  std::string operator()(const std::string* value) const { return fmt::format("\"{}\"", *value); }
};

struct Range {
  const ConfigurationField& field;

  std::string operator()(const bool*) const { return {}; }
  std::string operator()(const int*) const {  // TOML knows no 1e+06 that is a whole number
    return fmt::format("{:.0f} to {:.0f}", field.lowest, field.highest);
  }
  std::string operator()(const double*) const { return reals(); }
  std::string operator()(const std::optional<double>*) const { return reals(); }
  std::string operator()(const std::string*) const { return {}; }

 private:
  std::string reals() const { return fmt::format("{:.6g} to {:.6g}", field.lowest, field.highest); }
};

}  // namespace

std::string configuration_reference() {
  Configuration defaults;
  std::string page(kIntroduction);
  std::string_view section;
  for (const ConfigurationField& field : configuration_fields()) {
    if (field.section != section) {
      section = field.section;
      page += fmt::format(fmt::runtime(kTableHead), section, introduction_of(section));
    }
    const FieldPointer value = field.in(defaults);
    page += fmt::format("| `{}` | {} | {} | {} | {} | {} |\n", field.key, std::visit(TypeName{}, value),
                        std::visit(DefaultValue{}, value), field.unit, std::visit(Range{field}, value),
                        field.meaning);
  }
  return page;
}

}  // namespace swiftlet
