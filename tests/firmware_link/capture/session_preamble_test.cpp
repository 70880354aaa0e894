// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "firmware_link/capture/session_preamble.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "tests/firmware_link/frames.hpp"
#include "tests/firmware_link/synthetic_capture.hpp"

namespace swiftlet {
namespace {

using std::chrono::milliseconds;

void feed_all(LogSession& session, const std::vector<LinkFrame>& frames) {
  for (const LinkFrame& frame : frames) static_cast<void>(session.on_frame(frame));
}

/// "range.front=2000" and so on; empty when the packet cannot be read.
std::vector<std::string> decoded(LogSession& session, const LinkFrame& frame) {
  const std::optional<LogRecord> record = session.on_frame(frame);
  std::vector<std::string> values;
  for (std::size_t i = 0; record && i < record->entry_count; ++i)
    values.push_back(std::string(session.name_of(*record, i)) + "=" + std::to_string(record->value(i)));
  return values;
}

TEST(SessionPreamble, AFreshSessionReadsTheSameRecordsAfterIt) {
  const SyntheticCapture flight;
  LogSession live;
  feed_all(live, flight.handshake());
  LogSession fresh;
  feed_all(fresh, session_preamble(live, host_ms(42)));
  for (int i = 0; i < flight.packets; ++i) {
    const std::vector<std::string> values = decoded(live, flight.data(i));
    ASSERT_EQ(values.size(), 7U);
    EXPECT_EQ(decoded(fresh, flight.data(i)), values);
  }
  EXPECT_EQ(fresh.toc().info()->crc, live.toc().info()->crc);
  EXPECT_EQ(fresh.toc().info()->count, live.toc().info()->count);
  EXPECT_EQ(fresh.blocks()[1].period, milliseconds(100));
  EXPECT_TRUE(fresh.blocks()[1].running);
}

TEST(SessionPreamble, HasTheGivenTimeAndNamesOnlyVariablesInUse) {
  LogSession live;
  feed_all(live, SyntheticCapture().handshake());
  static_cast<void>(live.on_frame(received(toc_item_reply(6'000, LogType::kUint8, "pm", "state"))));
  const std::vector<LinkFrame> preamble = session_preamble(live, host_ms(42));
  EXPECT_EQ(preamble.size(), 2U * (1 + 7 + 3));  // info, items, delete, create, start
  for (const LinkFrame& frame : preamble) EXPECT_EQ(frame.at, host_ms(42));
  LogSession fresh;
  feed_all(fresh, preamble);
  EXPECT_FALSE(fresh.toc().has(6'000));
}

TEST(SessionPreamble, ChangesNothingInTheMiddleOfASession) {
  const SyntheticCapture flight;
  LogSession undisturbed;
  LogSession disturbed;
  feed_all(undisturbed, flight.handshake());
  feed_all(disturbed, flight.handshake());
  EXPECT_EQ(decoded(disturbed, flight.data(0)), decoded(undisturbed, flight.data(0)));
  feed_all(disturbed, session_preamble(disturbed, host_ms(42)));
  EXPECT_EQ(decoded(disturbed, flight.data(1)), decoded(undisturbed, flight.data(1)));
}

TEST(SessionPreamble, CreatesABlockOfMoreThanNineVariablesWithAPeriodInMilliseconds) {
  LogSession live;
  for (std::uint16_t id = 0; id < 12; ++id)
    static_cast<void>(live.on_frame(
        received(toc_item_reply(id, LogType::kUint16, "group", std::string("v") + std::to_string(id)))));
  for (const auto& [request, reply] :
       {std::pair{"5d 06 03 22 00 00 22 01 00 22 02 00 22 03 00", "5d 06 03 00"},
        std::pair{"5d 07 03 22 04 00 22 05 00 22 06 00 22 07 00", "5d 07 03 00"},
        std::pair{"5d 07 03 22 08 00 22 09 00 22 0a 00 22 0b 00", "5d 07 03 00"},
        std::pair{"5d 08 03 19 00", "5d 08 03 00"}}) {
    static_cast<void>(live.on_frame(sent(hex(request))));
    static_cast<void>(live.on_frame(received(hex(reply))));
  }
  LogSession fresh;
  feed_all(fresh, session_preamble(live, host_ms(42)));
  LogPacket packet(3, 1000);
  for (std::uint16_t value = 0; value < 12; ++value) packet.u16(value);
  const std::vector<std::string> values = decoded(live, received(packet.bytes()));
  ASSERT_EQ(values.size(), 12U);
  EXPECT_EQ(decoded(fresh, received(packet.bytes())), values);
  EXPECT_EQ(fresh.blocks()[3].period, milliseconds(25));
}

TEST(SessionPreamble, KeepsAPartlyCreatedBlockUncertain) {
  LogSession live;
  for (std::uint16_t id = 0; id < 2; ++id)
    static_cast<void>(
        live.on_frame(received(toc_item_reply(id, LogType::kUint16, "range", id == 0 ? "front" : "back"))));
  static_cast<void>(live.on_frame(sent(hex("5d 06 01 22 00 00 22 01 00"))));
  static_cast<void>(live.on_frame(received(hex("5d 06 01 0c"))));  // no room: made up to some entry
  LogSession fresh;
  feed_all(fresh, session_preamble(live, host_ms(42)));
  const LinkFrame half = received(LogPacket(1, 1000).u16(700).bytes());
  EXPECT_EQ(decoded(live, half), std::vector<std::string>{"range.front=700.000000"});
  EXPECT_EQ(decoded(fresh, half), std::vector<std::string>{"range.front=700.000000"});
  EXPECT_FALSE(fresh.blocks()[1].running);
}

}  // namespace
}  // namespace swiftlet
