// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "firmware_link/sample/heading_mending_source.hpp"

#include <string>

namespace swiftlet {

Result<ReceivedSample> HeadingMendingSource::next() {
  Result<ReceivedSample> received = flight_->next();
  if (received) leaps_.mend(received->sample);
  return received;
}

std::unique_ptr<SampleSource> HeadingMendingSource::again(std::optional<Duration> range_age) const {
  std::unique_ptr<SampleSource> flight = flight_->again(range_age);
  if (!flight) return nullptr;
  return std::make_unique<HeadingMendingSource>(std::move(flight));
}

void HeadingMendingSource::end() {
  flight_->end();
  report_at_end_ = flight_->report();
  if (leaps_.count() == 0) return;
  report_at_end_->notes.push_back(
      "the heading of the dead reckoning leaps " + std::to_string(leaps_.count()) +
      " times as no vehicle can turn (an error of its estimate): these turns were "
      "left out");
}

}  // namespace swiftlet
