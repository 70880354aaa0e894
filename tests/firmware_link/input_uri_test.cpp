// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "firmware_link/input_uri.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace swiftlet {
namespace {

using testing::HasSubstr;

TEST(InputUri, TakesReplaysAndPlainPathsAsFiles) {
  EXPECT_EQ(parse_input_uri("replay:a b/flight.pcap")->path, "a b/flight.pcap");
  EXPECT_EQ(parse_input_uri("/data/intel.clf.gz")->path, "/data/intel.clf.gz");
  EXPECT_EQ(parse_input_uri("odd:name.pcap")->path, "odd:name.pcap");
}

TEST(InputUri, TakesASimulationWithAndWithoutASeed) {
  const auto plain = parse_input_uri("sim://office");
  ASSERT_TRUE(plain.ok());
  EXPECT_EQ(plain->kind, InputUri::Kind::kSimulation);
  EXPECT_EQ(plain->world, "office");
  EXPECT_EQ(plain->seed, 1U);
  EXPECT_EQ(parse_input_uri("sim://maze?seed=18446744073709551615")->seed, 18446744073709551615U);
}

TEST(InputUri, SaysWhatIsWrongAndWhatToWrite) {
  const std::vector<std::pair<const char*, const char*>> cases{
      {"", "is empty; swiftlet takes"},
      {"replay:", "write replay:flight.pcap"},
      {"radio://0/80/2M", "unknown scheme 'radio'"},
      {"sim:office", "unknown scheme 'sim'"},
      {"sim://", "names no world"},
      {"sim://office?speed=1", "only parameter is seed"},
      {"sim://office?seed=", "whole number"},
      {"sim://office?seed=-1", "whole number"},
      {"sim://office?seed=1x", "whole number"},
  };
  for (const auto& [uri, expected] : cases) {
    const auto parsed = parse_input_uri(uri);
    ASSERT_FALSE(parsed.ok()) << uri;
    EXPECT_EQ(parsed.error().code, ErrorCode::kInvalidInput) << uri;
    EXPECT_THAT(parsed.error().message, HasSubstr(expected)) << uri;
  }
}

}  // namespace
}  // namespace swiftlet
