// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "daemon/outputs/mcap_writer.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <zstd.h>

#include <cstdint>
#include <string>

namespace swiftlet {
namespace {

using testing::EndsWith;
using testing::HasSubstr;
using testing::StartsWith;

const std::string kMagic("\x89MCAP0\r\n", 8);

const McapChannel kChannel{.id = 1,
                           .topic = "/a",
                           .message_encoding = "json",
                           .schema_name = "A",
                           .schema_encoding = "jsonschema",
                           .schema = "{}"};

template <typename Use>
std::string written(Use use) {
  std::string bytes;
  McapWriter writer(
      [&bytes](std::string_view more) {
        bytes += more;
        return true;
      },
      {kChannel});
  use(writer);
  writer.finish();
  return bytes;
}

std::string bytes_of(std::initializer_list<int> values) {
  std::string bytes;
  for (const int value : values) bytes += static_cast<char>(value);
  return bytes;
}

TEST(McapWriter, BeginsWithMagicHeaderSchemaAndChannel) {
  const std::string header = bytes_of({1, 16, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 8, 0, 0, 0}) + "swiftlet";
  const std::string schema = bytes_of({3, 27, 0, 0, 0, 0, 0, 0, 0, 1, 0, 1, 0, 0, 0}) + "A" +
                             bytes_of({10, 0, 0, 0}) + "jsonschema" + bytes_of({2, 0, 0, 0}) + "{}";
  const std::string channel = bytes_of({4, 22, 0, 0, 0, 0, 0, 0, 0, 1, 0, 1, 0, 2, 0, 0, 0}) + "/a" +
                              bytes_of({4, 0, 0, 0}) + "json" + bytes_of({0, 0, 0, 0});
  EXPECT_THAT(written([](McapWriter&) {}), StartsWith(kMagic + header + schema + channel));
}

/// The records of the only chunk.
std::string unpacked(const std::string& bytes) {
  const std::size_t frame = bytes.find("\x28\xb5\x2f\xfd");  // as zstd has it
  if (frame == std::string::npos) return {};
  std::string records(10'000, '\0');
  const std::size_t packed = ZSTD_findFrameCompressedSize(bytes.data() + frame, bytes.size() - frame);
  records.resize(ZSTD_decompress(records.data(), records.size(), bytes.data() + frame, packed));
  return records;
}

TEST(McapWriter, WritesAMessageWithItsChannelSequenceAndTimes) {
  const std::string message = bytes_of({5, 24, 0, 0, 0, 0, 0, 0, 0, 1, 0, 1, 0, 0, 0}) +
                              bytes_of({7, 0, 0, 0, 0, 0, 0, 0, 7, 0, 0, 0, 0, 0, 0, 0}) + "{}";
  EXPECT_THAT(unpacked(written([](McapWriter& writer) {
                writer.add(1, 5, "{}");
                writer.add(1, 7, "{}");
              })),
              EndsWith(message));
}

TEST(McapWriter, CompressesWhatRepeats) {
  const std::string bytes = written([](McapWriter& writer) {
    for (std::uint64_t i = 0; i < 50'000; ++i) writer.add(1, 1000 * i, "{\"some\":\"text to fill a chunk\"}");
  });
  const std::size_t index_bytes = 800'000;  // 16 a message
  EXPECT_LT(bytes.size(), index_bytes + 500'000U);
  EXPECT_THAT(bytes, HasSubstr(bytes_of({4, 0, 0, 0}) + "zstd"));
}

TEST(McapWriter, EndsWithFooterAndMagic) {
  const std::string bytes = written([](McapWriter& writer) { writer.add(1, 5, "{}"); });
  EXPECT_THAT(bytes, EndsWith(kMagic));
  ASSERT_GT(bytes.size(), 37U);
  EXPECT_EQ(bytes.substr(bytes.size() - 37, 9), bytes_of({2, 20, 0, 0, 0, 0, 0, 0, 0}));
}

TEST(McapWriter, WritesTheSameBytesForTheSameMessages) {
  const auto some = [](McapWriter& writer) {
    for (std::uint64_t i = 0; i < 50'000; ++i) writer.add(1, 1000 * i, "{\"some\":\"text to fill a chunk\"}");
  };
  EXPECT_EQ(written(some), written(some));
}

}  // namespace
}  // namespace swiftlet
