// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "tools/doctor/lcm_checks.hpp"

#include <optional>
#include <string>

#include "daemon/publish/lcm_transport.hpp"

namespace swiftlet {
namespace {

constexpr long long kBufferBytes = 2'097'152;  // what LCM's documentation asks for

std::string reach_of(const LcmUrl& url) {
  return url.ttl == 0 ? "this machine only" : "ttl " + std::to_string(url.ttl) + ": leaves this machine";
}

Finding check_route(const LcmUrl& url, Network& network) {
  const std::optional<NetworkRoute> route = network.route_to(url.group);
  if (!route)
    return {Mark::kProblem, "lcm route", "no route to " + url.group + ": swiftletd cannot publish",
            kRouteOverLoopback};
  const std::string by = url.group + " by " + route->interface;
  if (!route->is_multicast && route->is_loopback)
    return {Mark::kProblem, "lcm route", by + ", which does not multicast",
            "sudo ip link set lo multicast on"};
  if (!route->is_multicast)
    return {Mark::kProblem, "lcm route", by + ", which does not multicast", kRouteOverLoopback};
  if (route->is_loopback && url.ttl > 0)
    return {
        Mark::kWarning, "lcm route",
        by + ", although ttl is " + std::to_string(url.ttl) + ": others on the network will not receive it",
        "sudo ip route del 224.0.0.0/4 dev lo"};
  return {Mark::kOk, "lcm route", by + ", " + reach_of(url), ""};
}

Finding check_self_test(const LcmUrl& url, Network& network) {
  if (const Status received = network.send_to_self(url.group); !received)
    return {Mark::kProblem, "lcm self-test", received.error().message,
            "let the firewall pass UDP to " + url.group + ", or route it over lo: " + kRouteOverLoopback};
  return {Mark::kOk, "lcm self-test", "a datagram to " + url.group + " came back", ""};
}

Finding check_buffers(const SystemFiles& files) {
  std::string sizes;
  std::string too_small;
  for (const std::string name : {"rmem_max", "rmem_default"}) {
    const std::optional<long long> bytes = files.read_number("/proc/sys/net/core/" + name);
    if (!bytes) return {Mark::kSkipped, "lcm buffers", "the kernel does not report their sizes", ""};
    sizes += (sizes.empty() ? "" : ", ") + name + ' ' + std::to_string(*bytes);
    if (*bytes < kBufferBytes) too_small += " net.core." + name + '=' + std::to_string(kBufferBytes);
  }
  if (too_small.empty()) return {Mark::kOk, "lcm buffers", sizes, ""};
  return {
      Mark::kWarning, "lcm buffers", sizes + ": a busy receiver may lose map tiles",
      "sudo sysctl -w" + too_small + "; for good: share/swiftlet/60-swiftlet-lcm.conf into /etc/sysctl.d"};
}

}  // namespace

Findings check_lcm(const LcmUrl& url, Network& network, const SystemFiles& files) {
  if (url.provider == LcmUrl::Provider::kOther) {
    const std::string why = "the LCM URL is not udpm://";
    return {{Mark::kSkipped, "lcm route", why, ""},
            {Mark::kSkipped, "lcm self-test", why, ""},
            {Mark::kSkipped, "lcm buffers", why, ""}};
  }
  Findings findings{check_route(url, network)};
  findings.push_back(findings.front().mark == Mark::kProblem
                         ? Finding{Mark::kSkipped, "lcm self-test", "there is no way to send one", ""}
                         : check_self_test(url, network));
  findings.push_back(check_buffers(files));
  return findings;
}

}  // namespace swiftlet
