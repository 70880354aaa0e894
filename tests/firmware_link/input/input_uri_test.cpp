// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "firmware_link/input/input_uri.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <string>
#include <utility>
#include <vector>

#include "firmware_link/link/radio_address.hpp"
#include "firmware_link/link/udp_address.hpp"
#include "firmware_link/simulation/address.hpp"

namespace swiftlet {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

TEST(InputUri, AcceptsReplaysAndPlainPathsAsFiles) {
  EXPECT_EQ(parse_input_uri("replay:a b/flight.pcap")->as<InputFile>()->path, "a b/flight.pcap");
  EXPECT_EQ(parse_input_uri("replay:what?.pcap")->as<InputFile>()->path, "what?.pcap");
  EXPECT_EQ(parse_input_uri("/data/intel.clf.gz")->as<InputFile>()->path, "/data/intel.clf.gz");
  EXPECT_EQ(parse_input_uri("odd:name.pcap")->as<InputFile>()->path, "odd:name.pcap");
  EXPECT_TRUE(parse_input_uri("radio.pcap")->is(InputNature::kFile));
}

TEST(InputUri, AcceptsASimulationWithAndWithoutSeedAndLaps) {
  const auto parsed = parse_input_uri("sim://office");
  ASSERT_TRUE(parsed.ok());
  const auto* plain = parsed->as<SimulationAddress>();
  ASSERT_NE(plain, nullptr);
  EXPECT_EQ(plain->world, "office");
  EXPECT_EQ(plain->seed, 1U);
  EXPECT_EQ(plain->laps, 1);
  EXPECT_EQ(parse_input_uri("sim://office?seed=3&laps=1000")->as<SimulationAddress>()->laps, 1000);
  EXPECT_EQ(parse_input_uri("sim://office?fault=reset@60,slip@90:5")->as<SimulationAddress>()->faults.size(),
            2U);
  EXPECT_TRUE(parse_input_uri("sim://office?without=slips,lag").ok());
  EXPECT_EQ(parse_input_uri("sim://maze?seed=18446744073709551615")->as<SimulationAddress>()->seed,
            18446744073709551615U);
}

struct RadioCase {
  const char* uri;
  RadioAddress expected;
};

TEST(InputUri, AcceptsARadioAddressAndFillsInMissingParts) {
  constexpr std::array<std::uint8_t, 5> kFactory{0xE7, 0xE7, 0xE7, 0xE7, 0xE7};
  constexpr std::array<std::uint8_t, 5> kLast{0, 0, 0, 0, 1};
  constexpr std::array<std::uint8_t, 5> kOther{0xAB, 0xCD, 0xEF, 0x01, 0x23};
  const std::vector<RadioCase> cases{
      {"radio://", {"0", 80, RadioRate::k2Mbps, kFactory, true, {}}},
      {"radio://1", {"1", 80, RadioRate::k2Mbps, kFactory, true, {}}},
      {"radio://*/0", {"*", 0, RadioRate::k2Mbps, kFactory, true, {}}},
      {"radio://007/125/1M", {"7", 125, RadioRate::k1Mbps, kFactory, true, {}}},
      {"radio://0/80/2M/E7E7E7E7E7", {"0", 80, RadioRate::k2Mbps, kFactory, true, {}}},
      {"radio://0/80/250k/01", {"0", 80, RadioRate::k250Kbps, kLast, true, {}}},
      {"radio://0/80/2m/aBcDeF0123", {"0", 80, RadioRate::k2Mbps, kOther, true, {}}},
      {"radio://e7e7e7e7e7/3", {"E7E7E7E7E7", 3, RadioRate::k2Mbps, kFactory, true, {}}},
      {"radio://1234567890/3", {"1234567890", 3, RadioRate::k2Mbps, kFactory, true, {}}},
      {"radio://0?safelink=0", {"0", 80, RadioRate::k2Mbps, kFactory, false, {}}},
      {"radio://0/80/2M/1?rate_limit=50&safelink=1", {"0", 80, RadioRate::k2Mbps, kLast, true, 50}},
  };
  for (const auto& [uri, expected] : cases) {
    const auto parsed = parse_input_uri(uri);
    ASSERT_TRUE(parsed.ok()) << parsed.error().message;
    const auto* radio = parsed->as<RadioAddress>();
    ASSERT_NE(radio, nullptr) << uri;
    EXPECT_EQ(radio->dongle, expected.dongle) << uri;
    EXPECT_EQ(radio->channel, expected.channel) << uri;
    EXPECT_EQ(radio->rate, expected.rate) << uri;
    EXPECT_EQ(radio->address, expected.address) << uri;
    EXPECT_EQ(radio->safelink, expected.safelink) << uri;
    EXPECT_EQ(radio->rate_limit_hz, expected.rate_limit_hz) << uri;
  }
}

TEST(InputUri, AcceptsAVehicleOnACable) {
  EXPECT_EQ(parse_input_uri("usb://0")->as<UsbCableAddress>()->index, 0);
  EXPECT_EQ(parse_input_uri("usb://99")->as<UsbCableAddress>()->index, 99);
}

struct UdpCase {
  const char* uri;
  const char* host;
  std::uint16_t port;
};

TEST(InputUri, AcceptsAHostWithAndWithoutAPort) {
  const std::vector<UdpCase> cases{
      {"udp://127.0.0.1:19851", "127.0.0.1", 19851},
      {"udp://sim-1.local_net", "sim-1.local_net", 19850},
      {"udp://localhost:1", "localhost", 1},
      {"udp://[::1]", "::1", 19850},
      {"udp://[fe80::1%eth0]:65535", "fe80::1%eth0", 65535},
  };
  for (const auto& [uri, host, port] : cases) {
    const auto parsed = parse_input_uri(uri);
    ASSERT_TRUE(parsed.ok()) << parsed.error().message;
    const auto* udp = parsed->as<UdpAddress>();
    ASSERT_NE(udp, nullptr) << uri;
    EXPECT_EQ(udp->host, host) << uri;
    EXPECT_EQ(udp->port, port) << uri;
  }
}

TEST(InputUri, ReportsWhatIsWrongAndShowsAnExample) {
  const std::vector<std::pair<const char*, const char*>> cases{
      {"replay:", "names no file"},
      {"sim:office", "two slashes follow 'sim:'"},
      {"radio:0/80", "two slashes follow 'radio:'"},
      {"sim://", "names no world"},
      {"sim://?seed=1", "names no world"},
      {"sim://office?speed=1", "unknown parameter 'speed', known: seed, laps, fault, without"},
      {"sim://office?", "unknown parameter ''"},
      {"sim://office?seed", "seed must be a whole number"},
      {"sim://office?seed=", "seed must be a whole number"},
      {"sim://office?seed=-1", "seed must be a whole number"},
      {"sim://office?seed=1x", "seed must be a whole number"},
      {"sim://office?seed=18446744073709551616", "seed must be a whole number"},
      {"sim://office?seed=1&seed=2", "'seed' is given twice"},
      {"sim://office?laps=0", "laps must be a whole number from 1 to 1000"},
      {"sim://office?laps=1001", "laps must be a whole number from 1 to 1000"},
      {"radio:///80", "dongle '' must be"},
      {"radio://-1", "dongle '-1' must be"},
      {"radio://0/", "channel '' must be"},
      {"radio://0/126", "channel '126' must be a whole number from 0 to 125"},
      {"radio://0/-1", "channel '-1'"},
      {"radio://0/80/3M", "data rate '3M' must be 250K, 1M or 2M"},
      {"radio://0/80/2M/", "address '' must be 1 to 10 hexadecimal digits"},
      {"radio://0/80/2M/0xE7", "address '0xE7'"},
      {"radio://0/80/2M/-1", "address '-1'"},
      {"radio://0/80/2M/E7E7E7E7E700", "address 'E7E7E7E7E700'"},
      {"radio://0/80/2M/E7E7E7E7E7/1", "more parts than"},
      {"radio://0/80?safelink=yes", "safelink must be 0 or 1"},
      {"radio://0/80?rate_limit=49", "rate_limit must be a whole number from 50 to 10000"},
      {"radio://0/80?ackfilter=0", "unknown parameter 'ackfilter', known: safelink, rate_limit"},
      {"usb://", "must be a whole number from 0 to 99"},
      {"usb://100", "'100' must be"},
      {"usb://0?x=1", "'0?x=1' must be"},
      {"udp://", "names no host"},
      {"udp://:19850", "names no host"},
      {"udp://a b", "host 'a b'"},
      {"udp://host/path", "host 'host/path'"},
      {"udp://host:", "port '' must be a whole number from 1 to 65535"},
      {"udp://host:0", "port '0'"},
      {"udp://host:65536", "port '65536'"},
      {"udp://host:19850?x=1", "port '19850?x=1'"},
      {"udp://::1", "IPv6 address stands in brackets"},
      {"udp://[::1", "never closed"},
      {"udp://[::1]19850", "only :PORT may follow"},
      {"udp://[]", "names no host"},
  };
  for (const auto& [uri, expected] : cases) {
    const auto parsed = parse_input_uri(uri);
    ASSERT_FALSE(parsed.ok()) << uri;
    EXPECT_EQ(parsed.error().code, ErrorCode::kInvalidInput) << uri;
    EXPECT_THAT(parsed.error().message,
                AllOf(HasSubstr("input '" + std::string(uri) + "': "), HasSubstr(expected),
                      HasSubstr("; example: "), Not(HasSubstr("\n"))));
    const std::string example = parsed.error().message.substr(parsed.error().message.rfind(' ') + 1);
    EXPECT_TRUE(parse_input_uri(example).ok()) << example;
  }
}

TEST(InputUri, ListsTheFormsForAnUnknownScheme) {
  for (const auto& [uri, expected] : std::vector<std::pair<const char*, const char*>>{
           {"", "is empty"}, {"http://x.org/a.pcap", "unknown scheme 'http'"}, {"RADIO://0", "'RADIO'"}}) {
    const auto parsed = parse_input_uri(uri);
    ASSERT_FALSE(parsed.ok()) << uri;
    EXPECT_EQ(parsed.error().code, ErrorCode::kInvalidInput) << uri;
    EXPECT_THAT(
        parsed.error().message,
        AllOf(HasSubstr(expected), HasSubstr("; swiftlet takes radio://DONGLE/CHANNEL/RATE/ADDRESS")));
  }
}

}  // namespace
}  // namespace swiftlet
