// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <charconv>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/result.hpp"

namespace swiftlet {

// What the parsers of addresses in URIs share.

[[nodiscard]] Error bad_address(std::string what);
[[nodiscard]] std::string in_quotes(std::string_view text);

constexpr bool is_digit(char c) { return c >= '0' && c <= '9'; }
constexpr bool is_letter(char c) { return (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z'); }
/// ASCII only.
[[nodiscard]] std::string in_capitals(std::string_view text);

/// A whole number and nothing else.
template <typename T>
[[nodiscard]] std::optional<T> whole_number(std::string_view text, T lowest, T highest, int base = 10) {
  T number{};
  const char* end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, number, base);
  if (error != std::errc{} || stop != end || number < lowest || number > highest) return std::nullopt;
  return number;
}

/// Cuts off what precedes the first `separator`, and the separator; all, if there is none.
[[nodiscard]] std::string_view cut_off(std::string_view& text, char separator);

struct UriParameter {
  std::string_view key;
  std::string_view value;
};
/// Takes the "?key=value&key=value" off `text`. Error: kInvalidInput: a key is given twice.
[[nodiscard]] Result<std::vector<UriParameter>> take_parameters(std::string_view& text);
[[nodiscard]] Error unknown_parameter(std::string_view key, std::string_view known);

}  // namespace swiftlet
