// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "firmware_link/live_link.hpp"

#include <utility>

#include "core/base/check.hpp"
#include "firmware_link/udp_link.hpp"

namespace swiftlet {
namespace {

Status open_udp(const InputUri& uri, LiveLink& live) {
  Result<std::unique_ptr<UdpLink>> link = UdpLink::open(uri.host, uri.port, *live.clock);
  if (!link) return link.error();
  live.link = std::move(link).value();
  return {};
}

}  // namespace

Result<LiveLink> open_live_link(const InputUri& uri) {
  LiveLink live;
  live.clock = std::make_shared<SystemLinkClock>();
  SWIFTLET_CHECK(uri.kind == InputUri::Kind::kUdp, "the URI names a live link");
  const Status opened = open_udp(uri, live);
  if (!opened) return opened.error();
  return live;
}

}  // namespace swiftlet
