// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "firmware_link/link/udp_address.hpp"

#include <algorithm>

#include "firmware_link/link/uri_text.hpp"

namespace swiftlet {
namespace {

/// Parts HOST, HOST:PORT, [IPV6] or [IPV6]:PORT; the port with its colon, empty without one.
Status split_host(std::string_view text, std::string_view& host, std::string_view& port) {
  const bool bracketed = text.starts_with('[');
  if (bracketed) {
    const std::size_t closing = text.find(']');
    if (closing == std::string_view::npos)
      return bad_address("the bracket before the address is never closed");
    host = text.substr(1, closing - 1);
    port = text.substr(closing + 1);
    if (!port.empty() && port[0] != ':') return bad_address("only :PORT may follow the bracket");
  } else {
    const std::size_t colon = text.find(':');
    host = text.substr(0, colon);
    port = colon == std::string_view::npos ? std::string_view{} : text.substr(colon);
    if (port.find(':', 1) != std::string_view::npos)
      return bad_address("an IPv6 address stands in brackets: udp://[::1]:" +
                         std::to_string(kDefaultUdpPort));
  }
  const auto may_stand_in_host = [bracketed](char c) {
    return is_digit(c) || is_letter(c) || c == '.' || c == '-' || c == '_' ||
           (bracketed && (c == ':' || c == '%'));
  };
  if (host.empty()) return bad_address("names no host");
  if (!std::all_of(host.begin(), host.end(), may_stand_in_host))
    return bad_address("host " + in_quotes(host) + " must be a name or an address");
  return {};
}

}  // namespace

Result<UdpAddress> parse_udp_address(std::string_view text) {
  std::string_view host;
  std::string_view port;
  if (const Status split = split_host(text, host, port); !split) return split.error();
  UdpAddress address{.host = std::string(host)};
  if (port.empty()) return address;
  const std::optional<int> number = whole_number(port.substr(1), 1, 65535);
  if (!number)
    return bad_address("port " + in_quotes(port.substr(1)) + " must be a whole number from 1 to 65535");
  address.port = static_cast<std::uint16_t>(*number);
  return address;
}

}  // namespace swiftlet
