// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "tests/support/log_listener.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace swiftlet {
namespace {

constexpr std::uint8_t kBlock = 1;
constexpr std::uint8_t kPeriod10ms = 10;
constexpr std::uint8_t kFloat = 7;
constexpr Duration kRepeatAfter = std::chrono::milliseconds(200);
constexpr Duration kDataStaysAway = std::chrono::milliseconds(500);
constexpr Duration kReceiveTimeout = std::chrono::milliseconds(50);

CrtpPacket create_request() {
  CrtpPacket request = log_block_request(LogCommand::kCreate, kBlock);
  for (const std::uint16_t variable : {std::uint16_t{0}, std::uint16_t{1}})
    EXPECT_TRUE(add_log_entry(request, kFloat, variable));
  return request;
}

}  // namespace

void LogListener::listen(Duration duration) {
  const HostTime end = clock_.now() + duration;
  while (clock_.now() < end) {
    ask();
    const Result<LinkFrame> frame = link_.receive(kReceiveTimeout);
    if (frame) {
      on_frame(*frame);
    } else {
      ASSERT_EQ(frame.error().code, ErrorCode::kTimeout);
    }
  }
}

void LogListener::ask() {
  const HostTime now = clock_.now();
  if (now - kDataStaysAway < data_at_ || now - kRepeatAfter < asked_at_) return;
  asked_at_ = now;
  const CrtpPacket request = made_ ? log_start_request(kBlock, kPeriod10ms) : create_request();
  EXPECT_TRUE(link_.send(bytes_of(request)).ok());
}

void LogListener::on_frame(const LinkFrame& frame) {
  if (frame.direction == LinkDirection::kToVehicle) return;
  const std::span<const std::uint8_t> packet = frame.packet();
  if (is_on(packet, kLogDataTopic)) {
    received_.push_back(frame);
    data_at_ = frame.at;
    made_ = false;  // should it stay away, it may be gone
  } else if (is_on(packet, kLogControlTopic) && packet.size() >= 4) {
    ++replies_;
    const auto error = static_cast<LogError>(packet[3]);
    const bool was_create = packet[1] == static_cast<std::uint8_t>(LogCommand::kCreate);
    made_ = was_create ? error == LogError::kNone || error == LogError::kExists : error == LogError::kNone;
    if (was_create) asked_at_ = HostTime::min();
  }
}

std::optional<HostTime> LogListener::first_after(HostTime time) const {
  const auto frame = std::ranges::find_if(received_, [&](const LinkFrame& other) { return other.at > time; });
  return frame == received_.end() ? std::nullopt : std::optional(frame->at);
}

}  // namespace swiftlet
