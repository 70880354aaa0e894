// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <algorithm>
#include <charconv>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>

namespace swiftlet {

/// The whole text as a number; nullopt: it is none.
template <typename Number>
[[nodiscard]] std::optional<Number> parse_number(std::string_view text) {
  Number number{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return number;
}

/// Its beginning, fit for a message whatever the file holds.
[[nodiscard]] inline std::string quoted(std::string_view text) {
  constexpr std::size_t kMost = 40;
  std::string quote(text.substr(0, kMost));
  std::replace_if(
      quote.begin(), quote.end(), [](char c) { return c < ' ' || c > '~'; }, '?');
  return quote;
}

/// Cuts off what stands before the next `separator`.
[[nodiscard]] inline std::string_view next_field(std::string_view& rest, char separator) {
  const std::size_t end = rest.find(separator);
  const std::string_view field = rest.substr(0, end);
  rest = end == std::string_view::npos ? std::string_view() : rest.substr(end + 1);
  return field;
}

}  // namespace swiftlet
