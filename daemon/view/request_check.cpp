// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "daemon/view/request_check.hpp"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cctype>

namespace swiftlet {
namespace {

constexpr std::string_view kLocalhost = "localhost";

std::string lower(std::string_view text) {
  std::string out(text);
  for (char& c : out) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return out;
}

/// Of `name:port`, `[address]:port` or either without port.
std::string name_of_host(std::string_view host) {
  if (host.starts_with('[')) {
    const std::size_t end = host.find(']');
    return end == std::string_view::npos ? std::string() : lower(host.substr(1, end - 1));
  }
  return lower(host.substr(0, host.find(':')));
}

bool is_address(const std::string& name) {
  in6_addr unused{};
  return inet_pton(AF_INET, name.c_str(), &unused) == 1 || inet_pton(AF_INET6, name.c_str(), &unused) == 1;
}

bool is_loopback(const std::string& name) {
  return name == kLocalhost || (is_address(name) && (name.starts_with("127.") || name == "::1"));
}

bool is_own(const std::string& name, const OwnNames& own) {
  if (is_loopback(name)) return true;
  if (own.is_loopback) return false;
  return is_address(name) || std::find(own.names.begin(), own.names.end(), name) != own.names.end();
}

bool is_welcome(std::string_view origin, std::string_view host, const OwnNames& own) {
  const std::string name = lower(origin);
  if (name == "http://" + lower(host)) return true;
  return std::any_of(own.foreign_origins.begin(), own.foreign_origins.end(),
                     [&name](const std::string& allowed) { return lower(allowed) == name; });
}

}  // namespace

OwnNames own_names(const std::string& host) {
  OwnNames own{.is_loopback = is_loopback(lower(host)), .names = {}, .foreign_origins = {}};
  std::array<char, 256> name{};
  if (gethostname(name.data(), name.size() - 1) == 0 && name.front() != '\0') {
    own.names.push_back(lower(name.data()));
    own.names.push_back(own.names.front() + ".local");
  }
  return own;
}

std::optional<Refusal> refuse_request(const RequestHead& head, const OwnNames& own) {
  if (head.method != "GET" && head.method != "HEAD") return Refusal{405, "only GET is answered\n"};
  if (!is_own(name_of_host(head.host), own))
    return Refusal{403, "this server is not known by that name; use its address\n"};
  if (head.origin && !is_welcome(*head.origin, head.host, own))
    return Refusal{403, "pages of other sites are not answered\n"};
  return std::nullopt;
}

}  // namespace swiftlet
