// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "daemon/publish/lcm_url.hpp"

#include <arpa/inet.h>
#include <netinet/in.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <optional>
#include <string_view>

#include "daemon/publish/lcm_transport.hpp"

namespace swiftlet {
namespace {

Error invalid(const std::string& url, const std::string& what) {
  return {ErrorCode::kInvalidInput, "LCM URL '" + url + "': " + what + "; the default is " + kDefaultLcmUrl};
}

std::optional<int> as_number(std::string_view text, int lowest, int highest) {
  int number = 0;
  const char* end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, number);
  if (error != std::errc{} || stop != end || number < lowest || number > highest) return std::nullopt;
  return number;
}

bool is_multicast_group(const std::string& text) {
  in_addr address{};
  return inet_pton(AF_INET, text.c_str(), &address) == 1 && IN_MULTICAST(ntohl(address.s_addr));
}

Status parse_place(const std::string& url, std::string_view place, LcmUrl& parsed) {
  if (place.empty()) return {};
  const std::size_t colon = place.find(':');
  parsed.group = place.substr(0, colon);
  if (!is_multicast_group(parsed.group))
    return invalid(url, "'" + parsed.group + "' is no multicast address (224.0.0.0 to 239.255.255.255)");
  if (colon == std::string_view::npos) return {};
  const std::optional<int> port = as_number(place.substr(colon + 1), 1, 65'535);
  if (!port) return invalid(url, "the port must be a number from 1 to 65535");
  parsed.port = static_cast<std::uint16_t>(*port);
  return {};
}

Status parse_option(const std::string& url, std::string_view option, LcmUrl& parsed) {
  const std::size_t equals = option.find('=');
  const std::string_view key = option.substr(0, equals);
  const std::string_view value = equals == std::string_view::npos ? "" : option.substr(equals + 1);
  if (key == "recv_buf_size") return {};
  if (key != "ttl") return invalid(url, "unknown option '" + std::string(key) + "'");
  const std::optional<int> ttl = as_number(value, 0, 255);
  if (!ttl) return invalid(url, "ttl must be a number from 0 to 255");
  parsed.ttl = *ttl;
  return {};
}

/// LCM reads a log unless its mode says otherwise.
bool writes(std::string_view options) {
  return options.find("mode=w") != std::string_view::npos || options.find("mode=a") != std::string_view::npos;
}

}  // namespace

Result<LcmUrl> parse_lcm_url(const std::string& url) {
  constexpr std::string_view kMulticast = "udpm://";
  constexpr std::string_view kFile = "file://";
  constexpr std::array<std::string_view, 3> kOthers{kFile, "tcpq://", "memq://"};
  LcmUrl parsed;
  std::string_view rest(url);
  for (const std::string_view other : kOthers) {
    if (!rest.starts_with(other)) continue;
    parsed.provider = LcmUrl::Provider::kOther;
    if (other == kFile) parsed.file = rest.substr(kFile.size(), rest.find('?') - kFile.size());
    parsed.writes_file = other == kFile && writes(rest.substr(std::min(rest.find('?'), rest.size())));
    return parsed;
  }
  if (!rest.starts_with(kMulticast))
    return invalid(url, "must begin with udpm://, file://, tcpq:// or memq://");
  rest.remove_prefix(kMulticast.size());
  const std::size_t question = rest.find('?');
  if (Status place = parse_place(url, rest.substr(0, question), parsed); !place) return place.error();
  std::string_view query = question == std::string_view::npos ? "" : rest.substr(question + 1);
  while (!query.empty()) {
    const std::size_t end = std::min(query.find('&'), query.size());
    if (Status option = parse_option(url, query.substr(0, end), parsed); !option) return option.error();
    query.remove_prefix(std::min(end + 1, query.size()));
  }
  return parsed;
}

}  // namespace swiftlet
