// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "firmware_link/capture/replay_link.hpp"

#include <algorithm>
#include <chrono>

#include "firmware_link/crtp/crtp_packet.hpp"

namespace swiftlet {
namespace {

void add_once(std::vector<CaptureVehicle>& vehicles, const CaptureVehicle& vehicle) {
  if (std::ranges::find(vehicles, vehicle) == vehicles.end()) vehicles.push_back(vehicle);
}

}  // namespace

Result<std::unique_ptr<ReplayLink>> ReplayLink::open(const std::string& path, std::size_t passed_over) {
  Result<CaptureReader> reader = CaptureReader::open(path);
  if (!reader) return reader.error();
  std::unique_ptr<ReplayLink> link(new ReplayLink(std::move(reader).value()));
  const Status surveyed = link->survey();
  if (!surveyed) return surveyed.error();
  link->choose(passed_over);
  return link;
}

Status ReplayLink::survey() {
  HostTime last{};
  bool steps_back = false;
  stamps_.emplace();
  for (;;) {
    const Result<CaptureRecord> record = reader_.next();
    if (!record) {
      if (left_out_.empty()) {
        if (record.error().code == ErrorCode::kDamaged) return record.error();
        return Error{ErrorCode::kInvalidInput, reader_.path() + ": a capture without a single packet"};
      }
      break;
    }
    const CaptureVehicle& vehicle = record->vehicle;
    if (!MinuteStamps::may_be(record->frame.at)) stamps_.reset();
    steps_back = steps_back || last - record->frame.at > std::chrono::seconds(30);
    last = record->frame.at;
    add_once(left_out_, vehicle);
    if (record->frame.direction == LinkDirection::kFromVehicle &&
        is_on(record->frame.packet(), kLogDataTopic))
      add_once(senders_, vehicle);
  }
  if (reader_.skipped() > 0)
    notes_.push_back(std::to_string(reader_.skipped()) + " records passed over that hold no CRTP packet");
  if (stamps_ && steps_back)
    notes_.push_back(
        "its stamps hold the seconds of their minute alone (the vendor's client of 2022 to May 2024 wrote "
        "them): continued by the vehicle's clock, the date is unknown");
  reader_.rewind();
  return {};
}

void ReplayLink::choose(std::size_t passed_over) {
  followed_ = senders_.empty() ? left_out_.front() : senders_[std::min(passed_over, senders_.size() - 1)];
  std::erase(left_out_, followed_);
  for (const CaptureVehicle& vehicle : left_out_)
    notes_.push_back("follows " + followed_.text() + ", leaves out " + vehicle.text());
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
