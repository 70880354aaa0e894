// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "firmware_link/link/uri_text.hpp"

#include <algorithm>
#include <utility>

namespace swiftlet {

Error bad_address(std::string what) { return {ErrorCode::kInvalidInput, std::move(what)}; }

std::string in_quotes(std::string_view text) { return std::string(1, '\'').append(text) + '\''; }

std::string in_capitals(std::string_view text) {
  std::string capitals(text);
  for (char& c : capitals)
    if (c >= 'a' && c <= 'z') c = static_cast<char>(c - 'a' + 'A');
  return capitals;
}

std::string_view cut_off(std::string_view& text, char separator) {
  const std::size_t at = text.find(separator);
  const std::string_view part = text.substr(0, at);
  text = at == std::string_view::npos ? std::string_view{} : text.substr(at + 1);
  return part;
}

Result<std::vector<UriParameter>> take_parameters(std::string_view& text) {
  std::vector<UriParameter> parameters;
  const std::size_t question = text.find('?');
  if (question == std::string_view::npos) return parameters;
  std::string_view query = text.substr(question + 1);
  text = text.substr(0, question);
  do {
    std::string_view value = cut_off(query, '&');
    const std::string_view key = cut_off(value, '=');
    const auto same_key = [key](const UriParameter& earlier) { return earlier.key == key; };
    if (std::any_of(parameters.begin(), parameters.end(), same_key))
      return bad_address("parameter " + in_quotes(key) + " is given twice");
    parameters.push_back({key, value});
  } while (!query.empty());
  return parameters;
}

Error unknown_parameter(std::string_view key, std::string_view known) {
  return bad_address("unknown parameter " + in_quotes(key) + ", known: " + std::string(known));
}

}  // namespace swiftlet
