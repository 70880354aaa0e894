// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "firmware_link/input/input_uri.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <limits>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include "firmware_link/simulation/flight.hpp"

namespace swiftlet {
namespace {

// What is wrong with a part of a URI; nothing, if nothing is.
using Fault = std::optional<std::string>;

constexpr std::size_t kMaxDongleIndex = 9;  // digits; from 10 on they are a serial number
constexpr int kLastChannel = 125;
constexpr int kLastUsbIndex = 99;
// Slower than the lower one, the vehicle's log packets would pile up in it.
constexpr int kMinRateLimitHz = 20;
constexpr int kMaxRateLimitHz = 10'000;

std::string quoted(std::string_view text) { return std::string(1, '\'').append(text) + '\''; }

/// A whole number and nothing else.
template <typename T>
std::optional<T> whole_number(std::string_view text, T lowest, T highest, int base = 10) {
  T number{};
  const char* end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, number, base);
  if (error != std::errc{} || stop != end || number < lowest || number > highest) return std::nullopt;
  return number;
}

bool is_digit(char c) { return c >= '0' && c <= '9'; }
bool is_letter(char c) { return (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z'); }
std::string in_capitals(std::string_view text) {
  std::string capitals(text);
  for (char& c : capitals)
    if (c >= 'a' && c <= 'z') c = static_cast<char>(c - 'a' + 'A');
  return capitals;
}

/// Cuts off what precedes the first `separator`, and the separator; all, if there is none.
std::string_view cut_off(std::string_view& text, char separator) {
  const std::size_t at = text.find(separator);
  const std::string_view part = text.substr(0, at);
  text = at == std::string_view::npos ? std::string_view{} : text.substr(at + 1);
  return part;
}

struct Parameter {
  std::string_view key;
  std::string_view value;
};

/// Takes the "?key=value&key=value" off `rest`. Whether a key means anything is for the caller to say.
Fault take_parameters(std::string_view& rest, std::vector<Parameter>& parameters) {
  const std::size_t question = rest.find('?');
  if (question == std::string_view::npos) return std::nullopt;
  std::string_view query = rest.substr(question + 1);
  rest = rest.substr(0, question);
  do {
    std::string_view value = cut_off(query, '&');
    const std::string_view key = cut_off(value, '=');
    const auto same_key = [key](const Parameter& earlier) { return earlier.key == key; };
    if (std::any_of(parameters.begin(), parameters.end(), same_key))
      return "parameter " + quoted(key) + " is given twice";
    parameters.push_back({key, value});
  } while (!query.empty());
  return std::nullopt;
}

Fault unknown_parameter(std::string_view key, std::string_view known) {
  return "unknown parameter " + quoted(key) + ", known: " + std::string(known);
}

Fault parse_dongle(std::string_view text, RadioAddress& radio) {
  const bool is_word =
      std::all_of(text.begin(), text.end(), [](char c) { return is_digit(c) || is_letter(c); });
  if (text.empty() || (text != "*" && !is_word))
    return "dongle " + quoted(text) + " must be an index from 0, a serial number or *";
  const bool is_index = text.size() <= kMaxDongleIndex && std::all_of(text.begin(), text.end(), is_digit);
  // 00 and 0 are the same dongle.
  radio.dongle = is_index ? std::to_string(*whole_number(text, 0, 999'999'999)) : in_capitals(text);
  return std::nullopt;
}

Fault parse_channel(std::string_view text, RadioAddress& radio) {
  const std::optional<int> channel = whole_number(text, 0, kLastChannel);
  if (!channel) return "channel " + quoted(text) + " must be a whole number from 0 to 125";
  radio.channel = static_cast<std::uint8_t>(*channel);
  return std::nullopt;
}

Fault parse_rate(std::string_view text, RadioAddress& radio) {
  constexpr std::array<std::pair<std::string_view, RadioRate>, 3> kRates{
      {{"250K", RadioRate::k250Kbps}, {"1M", RadioRate::k1Mbps}, {"2M", RadioRate::k2Mbps}}};
  const std::string name = in_capitals(text);
  const auto* rate =
      std::find_if(kRates.begin(), kRates.end(), [&name](const auto& r) { return r.first == name; });
  if (rate == kRates.end()) return "data rate " + quoted(text) + " must be 250K, 1M or 2M";
  radio.rate = rate->second;
  return std::nullopt;
}

Fault parse_address(std::string_view text, RadioAddress& radio) {
  const auto number =
      text.size() > 2 * radio.address.size()
          ? std::nullopt
          : whole_number(text, std::uint64_t{0}, std::numeric_limits<std::uint64_t>::max(), 16);
  if (!number) return "address " + quoted(text) + " must be 1 to 10 hexadecimal digits";
  std::uint64_t left = *number;
  for (std::size_t i = radio.address.size(); i > 0; --i, left >>= 8)
    radio.address[i - 1] = static_cast<std::uint8_t>(left & 0xFF);
  return std::nullopt;
}

Fault apply_to_radio(const Parameter& parameter, RadioAddress& radio) {
  if (parameter.key == "safelink") {
    if (parameter.value != "0" && parameter.value != "1") return "safelink must be 0 or 1";
    radio.safelink = parameter.value == "1";
    return std::nullopt;
  }
  if (parameter.key == "rate_limit") {
    radio.rate_limit_hz = whole_number(parameter.value, kMinRateLimitHz, kMaxRateLimitHz);
    if (!radio.rate_limit_hz) return "rate_limit must be a whole number from 20 to 10000 (packets a second)";
    return std::nullopt;
  }
  return unknown_parameter(parameter.key, "safelink, rate_limit");
}

Fault parse_radio(std::string_view rest, InputUri& parsed) {
  constexpr std::array kParts{parse_dongle, parse_channel, parse_rate, parse_address};
  parsed.kind = InputUri::Kind::kRadio;
  std::vector<Parameter> parameters;
  if (Fault fault = take_parameters(rest, parameters)) return fault;
  if (std::count(rest.begin(), rest.end(), '/') >= std::ssize(kParts))
    return "has more parts than dongle, channel, data rate and address";
  bool more = !rest.empty();
  for (const auto& parse_part : kParts) {
    if (!more) break;
    more = rest.find('/') != std::string_view::npos;
    if (Fault fault = parse_part(cut_off(rest, '/'), parsed.radio)) return fault;
  }
  for (const Parameter& parameter : parameters)
    if (Fault fault = apply_to_radio(parameter, parsed.radio)) return fault;
  return std::nullopt;
}

Fault parse_usb_cable(std::string_view rest, InputUri& parsed) {
  parsed.kind = InputUri::Kind::kUsbCable;
  const std::optional<int> index = whole_number(rest, 0, kLastUsbIndex);
  if (!index) return "the vehicle " + quoted(rest) + " must be a whole number from 0 to 99";
  parsed.usb_index = *index;
  return std::nullopt;
}

/// Parts HOST, HOST:PORT, [IPV6] or [IPV6]:PORT; the port with its colon, empty without one.
Fault split_host(std::string_view rest, std::string_view& host, std::string_view& port) {
  const bool bracketed = rest.starts_with('[');
  if (bracketed) {
    const std::size_t closing = rest.find(']');
    if (closing == std::string_view::npos) return "the bracket before the address is never closed";
    host = rest.substr(1, closing - 1);
    port = rest.substr(closing + 1);
    if (!port.empty() && port[0] != ':') return "only :PORT may follow the bracket";
  } else {
    const std::size_t colon = rest.find(':');
    host = rest.substr(0, colon);
    port = colon == std::string_view::npos ? std::string_view{} : rest.substr(colon);
    if (port.find(':', 1) != std::string_view::npos)
      return "an IPv6 address stands in brackets: udp://[::1]:19850";
  }
  const auto may_stand_in_host = [bracketed](char c) {
    return is_digit(c) || is_letter(c) || c == '.' || c == '-' || c == '_' ||
           (bracketed && (c == ':' || c == '%'));
  };
  if (host.empty()) return "names no host";
  if (!std::all_of(host.begin(), host.end(), may_stand_in_host))
    return "host " + quoted(host) + " must be a name or an address";
  return std::nullopt;
}

Fault parse_udp(std::string_view rest, InputUri& parsed) {
  parsed.kind = InputUri::Kind::kUdp;
  std::string_view host;
  std::string_view port;
  if (Fault fault = split_host(rest, host, port)) return fault;
  parsed.host = host;
  if (port.empty()) return std::nullopt;
  const std::optional<int> number = whole_number(port.substr(1), 1, 65535);
  if (!number) return "port " + quoted(port.substr(1)) + " must be a whole number from 1 to 65535";
  parsed.port = static_cast<std::uint16_t>(*number);
  return std::nullopt;
}

Fault apply_to_simulation(const Parameter& parameter, InputUri& parsed) {
  if (parameter.key == "seed") {
    constexpr std::uint64_t kMax = std::numeric_limits<std::uint64_t>::max();
    const auto seed = whole_number(parameter.value, std::uint64_t{0}, kMax);
    if (!seed) return "the seed must be a whole number from 0 to 18446744073709551615";
    parsed.seed = *seed;
    return std::nullopt;
  }
  if (parameter.key != "laps") return unknown_parameter(parameter.key, "seed, laps");
  const auto laps = whole_number(parameter.value, 1, kMaxLaps);
  if (!laps) return "the laps must be a whole number from 1 to " + std::to_string(kMaxLaps);
  parsed.laps = *laps;
  return std::nullopt;
}

Fault parse_simulation(std::string_view rest, InputUri& parsed) {
  parsed.kind = InputUri::Kind::kSimulation;
  std::vector<Parameter> parameters;
  if (Fault fault = take_parameters(rest, parameters)) return fault;
  parsed.world = rest;
  if (parsed.world.empty()) return "names no world";
  for (const Parameter& parameter : parameters) {
    if (Fault fault = apply_to_simulation(parameter, parsed)) return fault;
  }
  return std::nullopt;
}

Fault parse_replay(std::string_view rest, InputUri& parsed) {
  parsed.path = rest;
  return rest.empty() ? Fault("names no file") : std::nullopt;
}

struct Scheme {
  std::string_view prefix;
  std::string_view example;
  Fault (*parse)(std::string_view rest, InputUri& parsed);
};
constexpr std::array<Scheme, 5> kSchemes{{
    {"radio://", "radio://0/80/2M/E7E7E7E7E7", parse_radio},
    {"usb://", "usb://0", parse_usb_cable},
    {"udp://", "udp://127.0.0.1:19850", parse_udp},
    {"sim://", "sim://office?seed=1", parse_simulation},
    {"replay:", "replay:flight.pcap", parse_replay},
}};

Error invalid(const std::string& uri, const std::string& what) {
  return {ErrorCode::kInvalidInput, "input '" + uri + "': " + what};
}

Error no_scheme(const std::string& uri, const std::string& what) {
  return invalid(uri, what +
                          "; swiftlet takes radio://DONGLE/CHANNEL/RATE/ADDRESS, usb://N, udp://HOST:PORT, "
                          "sim://WORLD?seed=N, replay:FILE or a path");
}

}  // namespace

Result<InputUri> parse_input_uri(const std::string& uri) {
  if (uri.empty()) return no_scheme(uri, "is empty");
  InputUri parsed;
  for (const Scheme& scheme : kSchemes) {
    const std::string_view name = scheme.prefix.substr(0, scheme.prefix.find(':') + 1);
    if (!uri.starts_with(name)) continue;
    const Fault fault = uri.starts_with(scheme.prefix)
                            ? scheme.parse(std::string_view(uri).substr(scheme.prefix.size()), parsed)
                            : Fault("two slashes follow " + quoted(name));
    if (fault) return invalid(uri, *fault + "; right is, for example, " + std::string(scheme.example));
    return parsed;
  }
  if (uri.find("://") != std::string::npos)
    return no_scheme(uri, "unknown scheme " + quoted(uri.substr(0, uri.find(':'))));
  parsed.path = uri;
  return parsed;
}

}  // namespace swiftlet
