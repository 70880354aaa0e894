// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include <gtest/gtest.h>

#include <chrono>
#include <set>
#include <string>
#include <utility>

#include "firmware_link/input/input_uri.hpp"
#include "firmware_link/input/link_sample_source.hpp"
#include "tests/firmware_link/frames.hpp"
#include "tests/firmware_link/udp_peer.hpp"

namespace swiftlet {
namespace {

TEST(InputKinds, ReadTheirOwnExamples) {
  std::set<std::string_view> schemes;
  for (const InputKind& kind : input_kinds()) {
    const Result<InputUri> uri = parse_input_uri(std::string(kind.example));
    ASSERT_TRUE(uri.ok()) << uri.error().message;
    EXPECT_EQ(uri->kind, &kind);
    EXPECT_TRUE(uri->address.has_value());
    EXPECT_TRUE(schemes.insert(kind.scheme).second) << kind.scheme << " names two kinds";
  }
}

TEST(InputKinds, OpenAndAttributeAllButFiles) {
  for (const InputKind& kind : input_kinds()) {
    const bool is_read = kind.nature == InputNature::kFile || kind.nature == InputNature::kFollowed;
    EXPECT_EQ(kind.open == nullptr, is_read) << kind.scheme;
    EXPECT_EQ(kind.recorded_vehicle == nullptr, is_read) << kind.scheme;
  }
}

TEST(InputForms, ListTheKindsAskedFor) {
  EXPECT_TRUE(
      input_forms({InputNature::kVehicle}).starts_with("radio://DONGLE/CHANNEL/RATE/ADDRESS, usb://N"));
  EXPECT_EQ(input_forms({InputNature::kFile, InputNature::kSimulation}),
            "sim://WORLD?seed=N&laps=N, replay:FILE or a path (.pcap, .csv or .clf, also in gzip)");
}

TEST(InputKinds, UdpReceivesTheVehicleInTheTimeOfItsClock) {
  UdpPeer peer;
  const InputUri uri = parse_input_uri("udp://127.0.0.1:" + std::to_string(peer.port())).value();
  Result<LinkInput> opened = uri.kind->open(uri.address);
  ASSERT_TRUE(opened.ok());
  const LinkInput input = std::move(opened).value();
  EXPECT_EQ(input.usb_bus, nullptr);
  EXPECT_FALSE(input.link->receive(Duration::zero()).ok());  // registers
  ASSERT_TRUE(peer.receive(1000).has_value());
  const HostTime before = input.clock->now();
  peer.send(hex("52 01 00 00 00"));
  const Result<LinkFrame> frame = input.link->receive(std::chrono::seconds(1));
  ASSERT_TRUE(frame.ok());
  EXPECT_GE(frame->at, before);
  EXPECT_LE(frame->at, input.clock->now());
}

CaptureVehicle recorded_vehicle(const char* text) {
  const InputUri uri = parse_input_uri(text).value();
  return uri.kind->recorded_vehicle(uri.address);
}

/// Of a vehicle that is not received by radio.
std::string serial_of(const char* uri) {
  const CaptureVehicle vehicle = recorded_vehicle(uri);
  EXPECT_EQ(vehicle.kind, CaptureLinkKind::kUsb);
  EXPECT_EQ(vehicle.channel, 0);
  return {vehicle.address.begin(), vehicle.address.end()};
}

TEST(RecordedVehicle, OfARadioIsItsAddressAndChannel) {
  EXPECT_EQ(recorded_vehicle("radio://0/80/2M/E7E7E7E701").text(), "radio E7E7E7E701 channel 80");
}

TEST(RecordedVehicle, OfAnyOtherLinkIsItsNameAsASerialNumber) {
  EXPECT_EQ(serial_of("udp://127.0.0.1:19850"), std::string("udp:19850\0\0\0", 12));
  EXPECT_EQ(serial_of("usb://2"), std::string("usb:2\0\0\0\0\0\0\0", 12));
  EXPECT_EQ(serial_of("sim://corridors"), "sim:corridor");
}

}  // namespace
}  // namespace swiftlet
