// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <algorithm>
#include <string_view>
#include <type_traits>

namespace swiftlet {

/// What a constant of a Tuning may be set to; both ends are within.
struct TuningRange {
  double lowest = 0.0;
  double highest = 0.0;
};

/// One rule for all: within a factor of the default, which keeps its sign and is no zero. Counts are 1 at
/// least, shares and cosines 1 at most, percentages 100.
template <typename Value>
TuningRange tuning_range(std::string_view key, const Value& default_value) {
  constexpr double kFactor = 100.0;
  const auto number = static_cast<double>(default_value);
  const auto names = [key](std::string_view word) { return key.find(word) != std::string_view::npos; };
  TuningRange range{number / kFactor, number * kFactor};
  if (std::is_integral_v<Value>) range.lowest = std::max(range.lowest, 1.0);
  if (names("share") || names("cosine")) range.highest = 1.0;
  if (names("percent")) range.highest = 100.0;
  return range;
}

}  // namespace swiftlet
