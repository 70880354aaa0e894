// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>

#include "daemon/config/configuration.hpp"

namespace swiftlet {

/// Where in a Configuration a field lives, and of what type it is.
using FieldPointer = std::variant<bool*, int*, double*, std::optional<double>*, std::string*>;

/// One key of a configuration file. The table of these serves loading, checking and the reference page.
struct ConfigurationField {
  std::string_view section;
  std::string_view key;
  std::string_view unit;  ///< empty where there is none
  std::string_view meaning;
  double lowest = 0.0;  ///< numbers only: both bounds may be taken
  double highest = 0.0;
  FieldPointer (*in)(Configuration& config) = nullptr;
};

/// In the order of the reference page, section by section.
[[nodiscard]] std::span<const ConfigurationField> configuration_fields();

/// What is wrong with this field's value in `config`, as "section.key = value: must lie between ..."; empty
/// when nothing is.
[[nodiscard]] std::string field_problem(const ConfigurationField& field, Configuration& config);

/// docs/configuration.md, whole.
[[nodiscard]] std::string configuration_reference();

}  // namespace swiftlet
