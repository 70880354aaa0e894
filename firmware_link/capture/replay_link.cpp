// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "firmware_link/capture/replay_link.hpp"

#include <algorithm>

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
  reader_.rewind();
  return {};
}

Result<LinkFrame> ReplayLink::receive(Duration /*timeout*/) {
  for (;;) {
    Result<CaptureRecord> record = reader_.next();
    if (!record) return record.error();
    if (record->vehicle == followed_) return record->frame;
  }
}

Status ReplayLink::send(std::span<const std::uint8_t> /*packet*/) { return {}; }

double ReplayLink::progress() const {
  return static_cast<double>(reader_.offset()) / static_cast<double>(reader_.size());
}

}  // namespace swiftlet
