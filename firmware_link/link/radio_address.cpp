// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "firmware_link/link/radio_address.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include "firmware_link/link/uri_text.hpp"

namespace swiftlet {
namespace {

constexpr std::size_t kMaxDongleIndex = 9;  // digits; from 10 on they are a serial number
constexpr int kLastChannel = 125;
// The vehicle sends 22 packets a second, its console and repetitions beside. What is fetched more slowly
// accumulates in it.
constexpr int kMinRateLimitHz = 50;
constexpr int kMaxRateLimitHz = 10'000;

Status parse_dongle(std::string_view text, RadioAddress& radio) {
  const bool is_word =
      std::all_of(text.begin(), text.end(), [](char c) { return is_digit(c) || is_letter(c); });
  if (text.empty() || (text != "*" && !is_word))
    return bad_address("dongle " + in_quotes(text) + " must be an index from 0, a serial number or *");
  const bool is_index = text.size() <= kMaxDongleIndex && std::all_of(text.begin(), text.end(), is_digit);
  // 00 and 0 are the same dongle.
  radio.dongle = is_index ? std::to_string(*whole_number(text, 0, 999'999'999)) : in_capitals(text);
  return {};
}

Status parse_channel(std::string_view text, RadioAddress& radio) {
  const std::optional<int> channel = whole_number(text, 0, kLastChannel);
  if (!channel) return bad_address("channel " + in_quotes(text) + " must be a whole number from 0 to 125");
  radio.channel = static_cast<std::uint8_t>(*channel);
  return {};
}

Status parse_rate(std::string_view text, RadioAddress& radio) {
  constexpr std::array<std::pair<std::string_view, RadioRate>, 3> kRates{
      {{"250K", RadioRate::k250Kbps}, {"1M", RadioRate::k1Mbps}, {"2M", RadioRate::k2Mbps}}};
  const std::string name = in_capitals(text);
  const auto* rate =
      std::find_if(kRates.begin(), kRates.end(), [&name](const auto& r) { return r.first == name; });
  if (rate == kRates.end()) return bad_address("data rate " + in_quotes(text) + " must be 250K, 1M or 2M");
  radio.rate = rate->second;
  return {};
}

Status parse_address(std::string_view text, RadioAddress& radio) {
  const auto number =
      text.size() > 2 * radio.address.size()
          ? std::nullopt
          : whole_number(text, std::uint64_t{0}, std::numeric_limits<std::uint64_t>::max(), 16);
  if (!number) return bad_address("address " + in_quotes(text) + " must be 1 to 10 hexadecimal digits");
  std::uint64_t left = *number;
  for (std::size_t i = radio.address.size(); i > 0; --i, left >>= 8)
    radio.address[i - 1] = static_cast<std::uint8_t>(left & 0xFF);
  return {};
}

Status apply(const UriParameter& parameter, RadioAddress& radio) {
  if (parameter.key == "safelink") {
    if (parameter.value != "0" && parameter.value != "1") return bad_address("safelink must be 0 or 1");
    radio.safelink = parameter.value == "1";
    return {};
  }
  if (parameter.key != "rate_limit") return unknown_parameter(parameter.key, "safelink, rate_limit");
  radio.rate_limit_hz = whole_number(parameter.value, kMinRateLimitHz, kMaxRateLimitHz);
  if (radio.rate_limit_hz) return {};
  return bad_address("rate_limit must be a whole number from 50 to 10000 (packets a second)");
}

}  // namespace

Result<RadioAddress> parse_radio_address(std::string_view text) {
  constexpr std::array kParts{parse_dongle, parse_channel, parse_rate, parse_address};
  const Result<std::vector<UriParameter>> parameters = take_parameters(text);
  if (!parameters) return parameters.error();
  if (std::count(text.begin(), text.end(), '/') >= std::ssize(kParts))
    return bad_address("has more parts than dongle, channel, data rate and address");
  RadioAddress radio;
  bool more = !text.empty();
  for (const auto& parse_part : kParts) {
    if (!more) break;
    more = text.find('/') != std::string_view::npos;
    if (const Status parsed = parse_part(cut_off(text, '/'), radio); !parsed) return parsed.error();
  }
  for (const UriParameter& parameter : *parameters)
    if (const Status applied = apply(parameter, radio); !applied) return applied.error();
  return radio;
}

}  // namespace swiftlet
