// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "firmware_link/crtp/log_value.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/firmware_link/frames.hpp"

namespace swiftlet {
namespace {

TEST(LogValue, DecodesEachType) {
  EXPECT_EQ(decode_log_value(LogType::kUint8, hex("ff")), 255.0);
  EXPECT_EQ(decode_log_value(LogType::kUint16, hex("fe 7f")), 32766.0);
  EXPECT_EQ(decode_log_value(LogType::kUint32, hex("ff ff ff ff")), 4294967295.0);
  EXPECT_EQ(decode_log_value(LogType::kInt8, hex("80")), -128.0);
  EXPECT_EQ(decode_log_value(LogType::kInt16, hex("89 ff")), -119.0);
  EXPECT_EQ(decode_log_value(LogType::kInt32, hex("00 00 00 80")), -2147483648.0);
  EXPECT_EQ(decode_log_value(LogType::kFloat, hex("05 00 00 3f")), 0.5 + 5.0 / (1 << 24));
}

TEST(LogValue, DecodesHalfPrecisionWithItsSpecialValues) {
  EXPECT_EQ(decode_log_value(LogType::kHalf, hex("00 3c")), 1.0);
  EXPECT_EQ(decode_log_value(LogType::kHalf, hex("00 c0")), -2.0);
  EXPECT_EQ(decode_log_value(LogType::kHalf, hex("ff 7b")), 65504.0);
  EXPECT_EQ(decode_log_value(LogType::kHalf, hex("55 35")), 0.333251953125);
  EXPECT_EQ(decode_log_value(LogType::kHalf, hex("00 04")), std::ldexp(1.0, -14));
  EXPECT_EQ(decode_log_value(LogType::kHalf, hex("01 00")), std::ldexp(1.0, -24));
  EXPECT_EQ(decode_log_value(LogType::kHalf, hex("ff 03")), std::ldexp(1023.0, -24));
  EXPECT_TRUE(std::signbit(decode_log_value(LogType::kHalf, hex("00 80"))));
  EXPECT_EQ(decode_log_value(LogType::kHalf, hex("00 fc")), -HUGE_VAL);
  EXPECT_TRUE(std::isnan(decode_log_value(LogType::kHalf, hex("01 7e"))));
}

TEST(LogValue, TypeByteIsReadWithoutItsUpperHalf) {
  EXPECT_EQ(log_type_of(0x77), LogType::kFloat);
  EXPECT_EQ(log_type_of(0x28), LogType::kHalf);
  EXPECT_EQ(log_type_of(0x20), std::nullopt);
  EXPECT_EQ(log_type_of(0x09), std::nullopt);
}

TEST(LogValue, TypesHaveNamesAndSizes) {
  const std::vector<std::pair<const char*, std::size_t>> types{{"uint8", 1}, {"uint16", 2}, {"uint32", 4},
                                                               {"int8", 1},  {"int16", 2},  {"int32", 4},
                                                               {"float", 4}, {"half", 2}};
  for (const auto& [name, size] : types) {
    ASSERT_TRUE(log_type_named(name).has_value()) << name;
    EXPECT_EQ(size_of(*log_type_named(name)), size) << name;
  }
  EXPECT_FALSE(log_type_named("double").has_value());
}

}  // namespace
}  // namespace swiftlet
