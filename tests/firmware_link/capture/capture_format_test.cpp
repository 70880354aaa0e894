// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "firmware_link/input/recorded_vehicle.hpp"

#include <gtest/gtest.h>

#include <string>

namespace swiftlet {
namespace {

TEST(CaptureVehicle, ReadsAsInAUri) {
  CaptureVehicle vehicle;
  vehicle.address = {0xE7, 0xE7, 0xE7, 0xE7, 0x01};
  vehicle.channel = 80;
  EXPECT_EQ(vehicle.text(), "radio E7E7E7E701 channel 80");
  vehicle.kind = CaptureLinkKind::kUsb;
  vehicle.address = {0x01, 0x23, 0x45, 0x67, 0x89, 0xAB, 0xCD, 0xEF, 0x01, 0x23, 0x45, 0x67};
  EXPECT_EQ(vehicle.text(), "usb 0123456789ABCDEF01234567");
}

InputUri input_of(InputUri::Kind kind) {
  InputUri input;
  input.kind = kind;
  return input;
}

/// Of a vehicle that is not received by radio.
std::string serial_of(const InputUri& input) {
  const CaptureVehicle vehicle = capture_vehicle_of(input);
  EXPECT_EQ(vehicle.kind, CaptureLinkKind::kUsb);
  EXPECT_EQ(vehicle.channel, 0);
  return {vehicle.address.begin(), vehicle.address.end()};
}

TEST(CaptureVehicle, OfARadioIsItsAddressAndChannel) {
  InputUri radio = input_of(InputUri::Kind::kRadio);
  radio.radio.address = {0xE7, 0xE7, 0xE7, 0xE7, 0x01};
  radio.radio.channel = 80;
  EXPECT_EQ(capture_vehicle_of(radio).text(), "radio E7E7E7E701 channel 80");
}

TEST(CaptureVehicle, OfAnyOtherLinkIsItsNameAsASerialNumber) {
  InputUri udp = input_of(InputUri::Kind::kUdp);
  udp.port = 19850;
  EXPECT_EQ(serial_of(udp), std::string("udp:19850\0\0\0", 12));
  InputUri cable = input_of(InputUri::Kind::kUsbCable);
  cable.usb_index = 2;
  EXPECT_EQ(serial_of(cable), std::string("usb:2\0\0\0\0\0\0\0", 12));
  InputUri simulation = input_of(InputUri::Kind::kSimulation);
  simulation.world = "corridors";
  EXPECT_EQ(serial_of(simulation), "sim:corridor");
}

}  // namespace
}  // namespace swiftlet
