// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "firmware_link/capture/replay_link.hpp"

#include <algorithm>
#include <chrono>

#include "firmware_link/crtp/crtp_packet.hpp"

namespace swiftlet {

Result<std::unique_ptr<ReplayLink>> ReplayLink::open(const std::string& path) {
  Result<CaptureReader> reader = CaptureReader::open(path);
  if (!reader) return reader.error();
  std::unique_ptr<ReplayLink> link(new ReplayLink(std::move(reader).value()));
  const Status surveyed = link->survey();
  if (!surveyed) return surveyed.error();
  return link;
}

Status ReplayLink::survey() {
  std::vector<CaptureVehicle> vehicles;  // in order of appearance
  bool sends_log_data = false;
  HostTime last{};
  bool steps_back = false;
  stamps_.emplace();
  for (;;) {
    const Result<CaptureRecord> record = reader_.next();
    if (!record) {
      if (vehicles.empty()) {
        if (record.error().code == ErrorCode::kDamaged) return record.error();
        return Error{ErrorCode::kInvalidInput, reader_.path() + ": a capture without a single packet"};
      }
      break;
    }
    const CaptureVehicle& vehicle = record->vehicle;
    if (!MinuteStamps::may_be(record->frame.at)) stamps_.reset();
    steps_back = steps_back || last - record->frame.at > std::chrono::seconds(30);
    last = record->frame.at;
    if (std::find(vehicles.begin(), vehicles.end(), vehicle) == vehicles.end()) vehicles.push_back(vehicle);
    if (!sends_log_data && record->frame.direction == LinkDirection::kFromVehicle &&
        is_on(record->frame.packet(), kLogDataTopic)) {
      sends_log_data = true;
      followed_ = vehicle;
    }
  }
  if (!sends_log_data) followed_ = vehicles.front();
  for (const CaptureVehicle& vehicle : vehicles)
    if (vehicle != followed_)
      notes_.push_back("follows " + followed_.text() + ", leaves out " + vehicle.text());
  if (reader_.skipped() > 0)
    notes_.push_back(std::to_string(reader_.skipped()) + " records passed over that hold no CRTP packet");
  if (stamps_ && steps_back)
    notes_.push_back(
        "its stamps hold the seconds of their minute alone (the vendor's client of 2022 to May 2024 wrote "
        "them): continued by the vehicle's clock, the date is unknown");
  reader_.rewind();
  return {};
}

Result<LinkFrame> ReplayLink::receive(Duration /*timeout*/) {
  for (;;) {
    Result<CaptureRecord> record = reader_.next();
    if (!record) return record.error();
    if (record->vehicle != followed_) continue;
    if (stamps_) record->frame.at = stamps_->unwrap(record->frame);
    return record->frame;
  }
}

Status ReplayLink::send(std::span<const std::uint8_t> /*packet*/) { return {}; }

double ReplayLink::progress() const {
  return static_cast<double>(reader_.offset()) / static_cast<double>(reader_.size());
}

}  // namespace swiftlet
