// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "firmware_link/simulation/log.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <initializer_list>
#include <optional>
#include <vector>

#include "tests/firmware_link/simulated_log_id.hpp"

namespace swiftlet {
namespace {

using Bytes = std::vector<std::uint8_t>;
using Milliseconds = std::chrono::milliseconds;

Bytes bytes_of(const std::optional<PacketBytes>& packet) {
  return packet ? Bytes(packet->begin(), packet->end()) : Bytes{};
}

class LogService : public testing::Test {
 protected:
  Bytes ask(const Bytes& packet, Milliseconds now = Milliseconds(5000)) {
    return bytes_of(log_.handle(packet, now));
  }
  /// Creates (6) or appends to (7) a block: the error code of the answer.
  std::uint8_t add(std::uint8_t command, std::uint8_t block, std::uint8_t fetch_type, std::uint16_t variable,
                   int times = 1) {
    Bytes packet{0x5D, command, block};
    for (int i = 0; i < times; ++i)
      for (const unsigned byte : {unsigned{fetch_type}, variable & 0xFFU, unsigned{variable} >> 8U})
        packet.push_back(static_cast<std::uint8_t>(byte));
    const Bytes answer = ask(packet);
    EXPECT_EQ(answer.size(), 4U);
    return answer.back();
  }
  /// The one-shot packet of a block with a single value.
  Bytes values_of(std::uint8_t fetch_type, std::uint16_t variable, const VehicleState& state) {
    EXPECT_EQ(add(6, 77, fetch_type, variable), 0);
    EXPECT_EQ(ask({0x5D, 0x03, 77, 0}).back(), 0);
    const auto packets = log_.sample(Milliseconds(5001), state);
    EXPECT_EQ(ask({0x5D, 0x02, 77}).back(), 0);
    EXPECT_EQ(packets.size(), 1U);
    return packets.empty() ? Bytes{} : Bytes(packets[0].begin() + 5, packets[0].end());
  }
  /// The times at which packets came, polling each millisecond.
  std::vector<int> packet_times(int from_ms, int to_ms) {
    std::vector<int> times;
    for (int t = from_ms; t < to_ms; ++t)
      for (std::size_t i = log_.sample(Milliseconds(t), VehicleState{}).size(); i > 0; --i)
        times.push_back(t);
    return times;
  }

  SimulatedLog log_{1};
};

TEST_F(LogService, ReturnsSizeKeyAndLimitsOfItsTable) {
  const Bytes answer = ask({0x5C, 0x03});
  ASSERT_EQ(answer.size(), 10U);
  const std::uint32_t crc = simulated_log_table_crc();
  const Bytes expected{0x50,
                       0x03,
                       static_cast<std::uint8_t>(simulated_log_table().size()),
                       static_cast<std::uint8_t>(simulated_log_table().size() >> 8U),
                       static_cast<std::uint8_t>(crc),
                       static_cast<std::uint8_t>(crc >> 8U),
                       static_cast<std::uint8_t>(crc >> 16U),
                       static_cast<std::uint8_t>(crc >> 24U),
                       0x10,
                       0x80};
  EXPECT_EQ(answer, expected);
}

TEST_F(LogService, ReturnsAnItemOfItsTable) {
  const std::uint16_t id = simulated_log_id("range", "front");
  const Bytes expected{
      0x50, 0x02, static_cast<std::uint8_t>(id), 0x00, 0x02, 'r', 'a', 'n', 'g', 'e', 0, 'f', 'r', 'o', 'n',
      't',  0};
  EXPECT_EQ(ask({0x5C, 0x02, static_cast<std::uint8_t>(id), 0x00}), expected);
}

TEST_F(LogService, AnswersWithTwoBytesBeyondItsTable) {
  EXPECT_EQ(ask({0x5C, 0x02, 0xFF, 0x7F}), (Bytes{0x50, 0x02}));
}

TEST_F(LogService, DoesNotAnswerThe8BitTableCommands) {
  EXPECT_TRUE(ask({0x5C, 0x00, 0x00}).empty());
  EXPECT_TRUE(ask({0x5C, 0x01}).empty());
}

TEST_F(LogService, CreatesAndStartsABlock) {
  EXPECT_EQ(ask({0x5D, 0x06, 0x01, 0x07, 0x3E, 0x00, 0x07, 0x3F, 0x00, 0x07, 0x40, 0x00, 0x07, 0x49, 0x00}),
            (Bytes{0x5D, 0x06, 0x01, 0x00}));
  EXPECT_FALSE(log_.has_running_block());
  EXPECT_EQ(ask({0x5D, 0x03, 0x01, 0x0A}), (Bytes{0x5D, 0x03, 0x01, 0x00}));
  EXPECT_TRUE(log_.has_running_block());
}

TEST_F(LogService, EchoesTheLinkBitsOfARequest) {
  EXPECT_EQ(ask({0x51, 0x05}), (Bytes{0x51, 0x05, 0x00, 0x00}));
  EXPECT_EQ(ask({0x5D, 0x05, 0xF8}), (Bytes{0x5D, 0x05, 0xF8, 0x00}));
}

TEST_F(LogService, RefusesTheSameBlockTwice) {
  EXPECT_EQ(add(6, 1, 7, 0), 0);
  EXPECT_EQ(ask({0x5D, 0x06, 0x01}), (Bytes{0x5D, 0x06, 0x01, 17}));
}

TEST_F(LogService, RefusesCommandsForABlockThatWasNotCreated) {
  for (const std::uint8_t command : Bytes{2, 4})
    EXPECT_EQ(ask({0x5D, command, 9}), (Bytes{0x5D, command, 9, 2}));
  EXPECT_EQ(ask({0x5D, 0x03, 9, 10}), (Bytes{0x5D, 0x03, 9, 2}));
  EXPECT_EQ(ask({0x5D, 0x08, 9, 100, 0}), (Bytes{0x5D, 0x08, 9, 2}));
  EXPECT_EQ(ask({0x5D, 0x07, 9, 7, 0, 0}), (Bytes{0x5D, 0x07, 9, 2}));
}

TEST_F(LogService, RefusesCommandsItDoesNotKnow) {
  EXPECT_EQ(ask({0x5D, 0x00, 1}), (Bytes{0x5D, 0x00, 1, 8}));
  EXPECT_EQ(ask({0x5D, 0x63, 1}), (Bytes{0x5D, 0x63, 1, 8}));
  EXPECT_EQ(ask({0x5D, 0x03, 1}), (Bytes{0x5D, 0x03, 1, 8})) << "cut short";
}

TEST_F(LogService, RefusesUnknownVariablesAndTypes) {
  EXPECT_EQ(add(6, 1, 7, 0x0FFF), 2);
  EXPECT_EQ(add(6, 2, 9, 0), 2);
}

TEST_F(LogService, AcceptsAtMost26BytesABlockAndKeepsWhatFitted) {
  const std::uint16_t x = simulated_log_id("stateEstimate", "x");
  EXPECT_EQ(add(6, 1, 7, x, 7), 7) << "28 bytes";
  EXPECT_EQ(add(7, 1, 2, x), 0) << "24 bytes are in, 26 go";
  EXPECT_EQ(add(7, 1, 1, x), 7);
  EXPECT_EQ(ask({0x5D, 0x03, 1, 0}).back(), 0);
  const auto packets = log_.sample(Milliseconds(5001), VehicleState{});
  ASSERT_EQ(packets.size(), 1U);
  EXPECT_EQ(packets[0].size(), 31U);
}

TEST_F(LogService, AcceptsAtMost16Blocks) {
  for (std::uint8_t block = 0; block < 16; ++block) EXPECT_EQ(add(6, block, 7, 0), 0);
  EXPECT_EQ(add(6, 16, 7, 0), 12);
  EXPECT_EQ(ask({0x5D, 0x02, 3}).back(), 0);
  EXPECT_EQ(add(6, 16, 7, 0), 0);
}

TEST_F(LogService, AcceptsAtMost128VariablesInAll) {
  for (std::uint8_t block = 0; block < 16; ++block) EXPECT_EQ(add(6, block, 1, 0, 8), 0);
  EXPECT_EQ(add(7, 5, 1, 0), 12);
}

TEST_F(LogService, ForgetsAllBlocksOnReset) {
  EXPECT_EQ(add(6, 1, 7, 0), 0);
  EXPECT_EQ(ask({0x5D, 0x03, 1, 10}).back(), 0);
  EXPECT_EQ(ask({0x5D, 0x05}).back(), 0);
  EXPECT_FALSE(log_.has_running_block());
  EXPECT_EQ(add(6, 1, 7, 0), 0);
}

TEST_F(LogService, SendsABlockAtItsPeriodFromOnePeriodAfterTheStart) {
  ASSERT_EQ(add(6, 1, 7, 0), 0);
  ASSERT_EQ(ask({0x5D, 0x03, 1, 10}, Milliseconds(5000)).back(), 0);
  const std::vector<int> times = packet_times(5001, 6050);
  ASSERT_EQ(times.size(), 10U);
  bool has_jitter = false;
  for (int i = 0; i < 10; ++i) {
    EXPECT_NEAR(times[static_cast<std::size_t>(i)], 5100 + 100 * i, 1) << "the beat keeps no jitter";
    has_jitter = has_jitter || times[static_cast<std::size_t>(i)] != 5100 + 100 * i;
  }
  EXPECT_TRUE(has_jitter);
}

TEST_F(LogService, StartsWithAPeriodInMillisecondsToo) {
  ASSERT_EQ(add(6, 1, 7, 0), 0);
  ASSERT_EQ(ask({0x5D, 0x08, 1, 0xF4, 0x01}, Milliseconds(5000)).back(), 0);
  const std::vector<int> times = packet_times(5001, 6100);
  ASSERT_EQ(times.size(), 2U);
  EXPECT_NEAR(times[0], 5500, 1);
}

TEST_F(LogService, StopsAndRestartsABlock) {
  ASSERT_EQ(add(6, 1, 7, 0), 0);
  ASSERT_EQ(ask({0x5D, 0x03, 1, 10}, Milliseconds(5000)).back(), 0);
  EXPECT_EQ(ask({0x5D, 0x04, 1}).back(), 0);
  EXPECT_TRUE(packet_times(5001, 5500).empty());
  ASSERT_EQ(ask({0x5D, 0x03, 1, 10}, Milliseconds(5500)).back(), 0);
  EXPECT_EQ(packet_times(5501, 5650).size(), 1U);
}

TEST_F(LogService, StampsPacketsWithTheLow24BitsOfItsClock) {
  ASSERT_EQ(add(6, 1, 2, simulated_log_id("range", "front")), 0);
  ASSERT_EQ(ask({0x5D, 0x03, 1, 0}).back(), 0);
  VehicleState state;
  state.front_mm = 0x1234;
  const auto packets = log_.sample(Milliseconds(0x1'02'03'04), state);
  ASSERT_EQ(packets.size(), 1U);
  EXPECT_EQ(Bytes(packets[0].begin(), packets[0].end()), (Bytes{0x52, 0x01, 0x04, 0x03, 0x02, 0x34, 0x12}));
  EXPECT_TRUE(log_.sample(Milliseconds(0x1'02'03'05), state).empty()) << "one shot is one packet";
}

TEST_F(LogService, PacksEachValueInItsRequestedType) {
  VehicleState state;
  state.x_m = -1.75;
  const std::uint16_t x = simulated_log_id("stateEstimate", "x");
  EXPECT_EQ(values_of(7, x, state), (Bytes{0x00, 0x00, 0xE0, 0xBF}));
  EXPECT_EQ(values_of(8, x, state), (Bytes{0x00, 0xBF}));
  EXPECT_EQ(values_of(5, x, state), (Bytes{0xFF, 0xFF})) << "cut off towards zero";
  EXPECT_EQ(values_of(4, x, state), (Bytes{0xFF}));
  state.front_mm = 32766.0;
  const std::uint16_t front = simulated_log_id("range", "front");
  EXPECT_EQ(values_of(2, front, state), (Bytes{0xFE, 0x7F}));
  EXPECT_EQ(values_of(3, front, state), (Bytes{0xFE, 0x7F, 0x00, 0x00}));
  EXPECT_EQ(values_of(0x72, front, state), (Bytes{0xFE, 0x7F})) << "the high nibble is ignored";
}

TEST_F(LogService, RoundsToHalfPrecision) {
  const std::uint16_t x = simulated_log_id("stateEstimate", "x");
  const auto half = [&](double value) -> unsigned {
    VehicleState state;
    state.x_m = value;
    const Bytes bytes = values_of(8, x, state);
    return bytes[0] + 256U * bytes[1];
  };
  EXPECT_EQ(half(0.0), 0x0000U);
  EXPECT_EQ(half(1.0), 0x3C00U);
  EXPECT_EQ(half(1.0 + 1.0 / 2048.0), 0x3C00U) << "a tie goes to the even neighbour";
  EXPECT_EQ(half(1.0 + 3.0 / 2048.0), 0x3C02U);
  EXPECT_EQ(half(2047.9), 0x6800U) << "rounds up into the next power of two";
  EXPECT_EQ(half(65504.0), 0x7BFFU);
  EXPECT_EQ(half(-1e6), 0xFC00U);
  EXPECT_EQ(half(0x1p-24), 0x0001U);
  EXPECT_EQ(half(std::nan("")) & 0x7FFFU, 0x7E00U);
}

}  // namespace
}  // namespace swiftlet
