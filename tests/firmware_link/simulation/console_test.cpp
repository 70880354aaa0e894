// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "firmware_link/simulation/console.hpp"

#include <gtest/gtest.h>

#include <string>

namespace swiftlet {
namespace {

TEST(SimulatedConsole, HasNothingToSendAtFirst) {
  SimulatedConsole console;
  EXPECT_FALSE(console.next().has_value());
}

TEST(SimulatedConsole, CutsALineIntoPacketsOf30Characters) {
  SimulatedConsole console;
  const std::string line(70, 'x');
  console.print(line);
  std::string text;
  for (const std::size_t size : {31U, 31U, 12U}) {
    const auto packet = console.next();
    ASSERT_TRUE(packet.has_value());
    EXPECT_EQ(packet->size(), size);
    EXPECT_EQ((*packet)[0], 0x00) << "port 0, channel 0";
    text.append(packet->begin() + 1, packet->end());
  }
  EXPECT_EQ(text, line + "\n");
  EXPECT_FALSE(console.next().has_value());
}

TEST(SimulatedConsole, LosesTextThatExceedsTheQueue) {
  SimulatedConsole console;
  for (int i = 0; i < 300; ++i) console.print("line");
  int packets = 0;
  while (console.next()) ++packets;
  EXPECT_EQ(packets, 200);
}

TEST(SimulatedConsole, DiscardsUnsentTextWhenCleared) {
  SimulatedConsole console;
  console.print("line");
  console.clear();
  EXPECT_FALSE(console.next().has_value());
}

}  // namespace
}  // namespace swiftlet
