// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "firmware_link/input/live_link.hpp"

#include <utility>

#include "core/base/check.hpp"
#include "firmware_link/link/libusb_bus.hpp"
#include "firmware_link/link/radio_link.hpp"
#include "firmware_link/link/udp_link.hpp"
#include "firmware_link/link/usb_cable_link.hpp"

namespace swiftlet {
namespace {

Status open_udp(const InputUri& uri, LiveLink& live) {
  Result<std::unique_ptr<UdpLink>> link = UdpLink::open(uri.host, uri.port, *live.clock);
  if (!link) return link.error();
  live.link = std::move(link).value();
  return {};
}

Status open_usb(const InputUri& uri, LiveLink& live) {
  Result<std::unique_ptr<UsbBus>> bus = LibusbBus::open();
  if (!bus) return bus.error();
  live.usb_bus = std::move(bus).value();
  if (uri.kind == InputUri::Kind::kRadio) {
    live.link = std::make_unique<RadioLink>(*live.usb_bus, *live.clock, uri.radio);
  } else {
    live.link = std::make_unique<UsbCableLink>(*live.usb_bus, *live.clock, uri.usb_index);
  }
  return {};
}

}  // namespace

Result<LiveLink> open_live_link(const InputUri& uri) {
  using Kind = InputUri::Kind;
  SWIFTLET_CHECK(uri.kind == Kind::kRadio || uri.kind == Kind::kUsbCable || uri.kind == Kind::kUdp,
                 "the URI names a live link");
  LiveLink live;
  live.clock = std::make_shared<SystemLinkClock>();
  const Status opened = uri.kind == Kind::kUdp ? open_udp(uri, live) : open_usb(uri, live);
  if (!opened) return opened.error();
  return live;
}

}  // namespace swiftlet
