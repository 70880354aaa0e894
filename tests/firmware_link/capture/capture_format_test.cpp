// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "firmware_link/capture/capture_format.hpp"

#include <gtest/gtest.h>

namespace swiftlet {
namespace {

TEST(CaptureVehicle, PrintsItsAddressAsInAUri) {
  CaptureVehicle vehicle;
  vehicle.address = {0xE7, 0xE7, 0xE7, 0xE7, 0x01};
  vehicle.channel = 80;
  EXPECT_EQ(vehicle.text(), "radio E7E7E7E701 channel 80");
  vehicle.kind = CaptureLinkKind::kUsb;
  vehicle.address = {0x01, 0x23, 0x45, 0x67, 0x89, 0xAB, 0xCD, 0xEF, 0x01, 0x23, 0x45, 0x67};
  EXPECT_EQ(vehicle.text(), "usb 0123456789ABCDEF01234567");
}

}  // namespace
}  // namespace swiftlet
