// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "firmware_link/session/block_description.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>

#include "tests/support/temporary_file.hpp"

namespace swiftlet {
namespace {

using testing::HasSubstr;

TEST(BlockDescription, ReadsTheDocumentedExample) {
  const TemporaryFile file("capture.pcap.toml", R"(
[[block]]
id = 1
period_ms = 100
variables = [
  { name = "stateEstimate.x", type = "float" },
  { name = "range.front", type = "uint16" },
]
[[block]]
id = 200
variables = [ { name = "range.left", type = "half" } ]
)");
  const auto description = read_block_description(file.path());
  ASSERT_TRUE(description.ok()) << description.error().message;
  ASSERT_EQ(description->blocks.size(), 2U);
  const auto& block = description->blocks.at(1);
  EXPECT_EQ(block.period, std::chrono::milliseconds(100));
  ASSERT_EQ(block.variables.size(), 2U);
  EXPECT_EQ(block.variables[1].name, "range.front");
  EXPECT_EQ(block.variables[1].type, LogType::kUint16);
  EXPECT_EQ(description->blocks.at(200).variables[0].type, LogType::kHalf);
}

TEST(BlockDescription, NamesFileAndLineOfEachMistake) {
  const std::vector<std::pair<std::string, std::string>> cases{
      {"x = ", ":1: "},
      {"", "no [[block]]"},
      {"blok = 1", ":1: unknown key 'blok'"},
      {"[[block]]\nid = 256\nvariables = []", ":1: a block needs an id"},
      {"[[block]]\nid = 1\nperiod = 3", ":3: unknown key 'period'"},
      {"[[block]]\nid = 1\nperiod_ms = 0\n", ":3: period_ms"},
      {"[[block]]\nid = 1\n", "needs variables"},
      {"[[block]]\nid = 1\nvariables = [\n{ name = \"a\" } ]", ":4: write { name"},
      {"[[block]]\nid = 1\nvariables = [\n{ name = \"a\", type = \"real\" } ]", ":4: no type 'real'"},
      {"[[block]]\nid=1\nvariables=[{name=\"a\",type=\"half\"}]\n[[block]]\nid=1\nvariables=[]",
       "block 1 twice"},
      {"[[block]]\nid=1\nvariables=[{name=\"a\",type=\"float\"},{name=\"a\",type=\"float\"},{name=\"a\",type="
       "\"float\"},"
       "{name=\"a\",type=\"float\"},{name=\"a\",type=\"float\"},{name=\"a\",type=\"float\"},\n"
       "{name=\"a\",type=\"float\"}]",
       ":4: more than 26 bytes"},
  };
  for (const auto& [text, expected] : cases) {
    const TemporaryFile file("bad.toml", text);
    const auto description = read_block_description(file.path());
    ASSERT_FALSE(description.ok()) << text;
    EXPECT_EQ(description.error().code, ErrorCode::kInvalidInput) << text;
    EXPECT_THAT(description.error().message, HasSubstr(file.path() + ":")) << text;
    EXPECT_THAT(description.error().message, HasSubstr(expected)) << text;
  }
}

TEST(BlockDescription, AnAbsentFileIsNotFound) {
  const auto description = read_block_description("/nonexistent/capture.pcap.toml");
  ASSERT_FALSE(description.ok());
  EXPECT_EQ(description.error().code, ErrorCode::kNotFound);
}

}  // namespace
}  // namespace swiftlet
