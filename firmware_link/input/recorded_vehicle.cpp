// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "firmware_link/input/recorded_vehicle.hpp"

#include <algorithm>
#include <string>

#include "core/base/check.hpp"

namespace swiftlet {
namespace {

std::string name_of(const InputUri& input) {
  switch (input.kind) {
    case InputUri::Kind::kUsbCable:
      return "usb:" + std::to_string(input.usb_index);
    case InputUri::Kind::kUdp:
      return "udp:" + std::to_string(input.port);
    case InputUri::Kind::kSimulation:
      return "sim:" + input.world;
    case InputUri::Kind::kRadio:
    case InputUri::Kind::kFile:
      break;
  }
  SWIFTLET_CHECK(false, "a radio has an address, and a file no vehicle of its own");
  return {};
}

}  // namespace

CaptureVehicle capture_vehicle_of(const InputUri& input) {
  CaptureVehicle vehicle;
  if (input.kind == InputUri::Kind::kRadio) {
    std::ranges::copy(input.radio.address, vehicle.address.begin());
    vehicle.channel = input.radio.channel;
    return vehicle;
  }
  vehicle.kind = CaptureLinkKind::kUsb;
  const std::string name = name_of(input).substr(0, vehicle.address.size());
  std::ranges::copy(name, vehicle.address.begin());
  return vehicle;
}

}  // namespace swiftlet
