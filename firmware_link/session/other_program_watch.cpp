// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "firmware_link/session/other_program_watch.hpp"

#include <algorithm>
#include <chrono>
#include <utility>

#include "firmware_link/crtp/crtp_packet.hpp"
#include "firmware_link/session/round_trip.hpp"

namespace swiftlet {
namespace {

constexpr Duration kReportPeriod = std::chrono::minutes(1);
// Ports and channels on which the vehicle only answers requests, and this program sends none, or no longer.
constexpr std::array<CrtpTopic, 9> kAnswersOnly{kLogTocTopic,    kParamTocTopic,   kParamReadTopic,
                                                CrtpTopic{2, 2}, CrtpTopic{4, 0},  CrtpTopic{4, 1},
                                                CrtpTopic{4, 2}, kLinkSourceTopic, kPlatformVersionTopic};

bool is_own_block(std::uint8_t id) { return id >= 1 && id <= kMaxOwnLogBlocks; }

bool is_unasked(std::span<const std::uint8_t> packet) {
  if (packet.size() < 3) return false;
  if (is_on(packet, kLinkEchoTopic)) return !RoundTrip::is_own(packet);
  if (is_on(packet, kLogDataTopic)) return !is_own_block(packet[1]);
  if (is_on(packet, kLogControlTopic))
    return packet[1] == static_cast<std::uint8_t>(LogCommand::kReset) || !is_own_block(packet[2]);
  return std::ranges::any_of(kAnswersOnly, [packet](CrtpTopic topic) { return is_on(packet, topic); });
}

}  // namespace

void OtherProgramWatch::on_frame(std::span<const std::uint8_t> packet, HostTime at) {
  if (is_unasked(packet)) on_sign(answers_, at);
}

void OtherProgramWatch::on_record(const LogRecord& record) {
  if (!is_own_block(record.block_id)) return;
  std::optional<DeviceTime>& last = data_at_[record.block_id - 1U];
  if (last == record.at) on_sign(doubles_, record.received);
  last = record.at;
}

void OtherProgramWatch::on_sign(Signs& signs, HostTime at) {
  if (signs.count == 0 || at - signs.first_at > signs.within) {
    signs.count = 0;
    signs.first_at = at;
  }
  if (++signs.count < signs.enough) return;
  signs.count = 0;
  if (reported_at_ && at - *reported_at_ < kReportPeriod) return;
  reported_at_ = at;
  event_ = signs.event;
}

std::optional<VehicleEvent> OtherProgramWatch::take_event() { return std::exchange(event_, std::nullopt); }

}  // namespace swiftlet
