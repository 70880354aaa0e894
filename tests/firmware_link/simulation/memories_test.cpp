// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "firmware_link/simulation/memories.hpp"

#include <gtest/gtest.h>

#include <numeric>
#include <vector>

namespace swiftlet {
namespace {

using Bytes = std::vector<std::uint8_t>;

class Memories : public testing::Test {
 protected:
  Bytes ask(const Bytes& packet) {
    const auto reply = memories_.handle(packet);
    return reply ? Bytes(reply->begin(), reply->end()) : Bytes{};
  }
  SimulatedMemories memories_;
};

TEST_F(Memories, ReturnTheirNumber) { EXPECT_EQ(ask({0x4C, 0x01}), (Bytes{0x40, 0x01, 0x02})); }

TEST_F(Memories, DescribeThemselves) {
  EXPECT_EQ(ask({0x4C, 0x02, 0x00}),
            (Bytes{0x40, 0x02, 0x00, 0x00, 0x00, 0x20, 0x00, 0x00, 0, 0, 0, 0, 0, 0, 0, 0}));
  EXPECT_EQ(ask({0x4C, 0x02, 0x01}),
            (Bytes{0x40, 0x02, 0x01, 0x15, 0x00, 0x10, 0x00, 0x00, 0, 0, 0, 0, 0, 0, 0, 0}));
}

TEST_F(Memories, AnswerWithoutContentsForAMissingMemory) {
  EXPECT_EQ(ask({0x4C, 0x02, 0x02}), (Bytes{0x40, 0x02, 0x02}));
}

TEST_F(Memories, HoldTheRadioSettingsWithTheirChecksum) {
  Bytes block = ask({0x4D, 0x00, 0, 0, 0, 0, 21});
  ASSERT_EQ(block.size(), 28U);
  EXPECT_EQ(Bytes(block.begin(), block.begin() + 7), (Bytes{0x41, 0, 0, 0, 0, 0, 0}));
  block.erase(block.begin(), block.begin() + 7);
  EXPECT_EQ(Bytes(block.begin(), block.begin() + 7), (Bytes{'0', 'x', 'B', 'C', 1, 80, 2}));
  EXPECT_EQ(block.back(), std::accumulate(block.begin(), block.end() - 1, 0) % 256);
}

TEST_F(Memories, KeepWhatIsWrittenToTheEeprom) {
  EXPECT_EQ(ask({0x4E, 0x00, 0x10, 0x01, 0, 0, 0xAA, 0xBB}), (Bytes{0x42, 0x00, 0x10, 0x01, 0, 0, 0}));
  EXPECT_EQ(ask({0x4D, 0x00, 0x0F, 0x01, 0, 0, 4}),
            (Bytes{0x41, 0x00, 0x0F, 0x01, 0, 0, 0, 0xFF, 0xAA, 0xBB, 0xFF}));
}

TEST_F(Memories, ShowTheLowByteOfEachAddressInTheTester) {
  EXPECT_EQ(ask({0x4D, 0x01, 0xFE, 0x00, 0, 0, 3}),
            (Bytes{0x41, 0x01, 0xFE, 0x00, 0, 0, 0, 0xFE, 0xFF, 0x00}));
  EXPECT_EQ(ask({0x4E, 0x01, 0, 0, 0, 0, 1}), (Bytes{0x42, 0x01, 0, 0, 0, 0, 0}));
}

TEST_F(Memories, RefuseAddressesOutside) {
  constexpr std::uint8_t kIoError = 5;
  EXPECT_EQ(ask({0x4D, 0x00, 0xFF, 0x1F, 0, 0, 2}).back(), kIoError);
  EXPECT_EQ(ask({0x4E, 0x00, 0xFF, 0x1F, 0, 0, 1, 2}).back(), kIoError);
  EXPECT_EQ(ask({0x4D, 0x02, 0, 0, 0, 0, 1}).back(), kIoError);
  EXPECT_EQ(ask({0x4D, 0x00, 0, 0, 0, 0, 25}).back(), kIoError) << "more than a packet holds";
}

TEST_F(Memories, DoNotAnswerRequestsThatAreTooShort) {
  for (const Bytes& packet :
       {Bytes{0x4C}, Bytes{0x4C, 0x02}, Bytes{0x4D, 0x00, 0, 0, 0, 0}, Bytes{0x4E, 0x00}})
    EXPECT_TRUE(ask(packet).empty());
}

}  // namespace
}  // namespace swiftlet
