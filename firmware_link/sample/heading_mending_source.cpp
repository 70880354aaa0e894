// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "firmware_link/sample/heading_mending_source.hpp"

#include <cstdint>
#include <string>

namespace swiftlet {

Result<ReceivedSample> HeadingMendingSource::next() {
  Result<ReceivedSample> received = inner().next();
  if (received) leaps_.mend(received->sample);
  return received;
}

std::optional<VehicleEvent> HeadingMendingSource::take_event() {
  if (leaps_told_ == leaps_.count()) return inner().take_event();
  leaps_told_ = leaps_.count();
  return VehicleEvent{VehicleEvent::Kind::kHeadingLeapt, static_cast<std::int32_t>(leaps_told_)};
}

void HeadingMendingSource::end() {
  ForwardingSource::end();
  if (leaps_.count() == 0) return;
  add_note("the heading of the dead reckoning leaps " + std::to_string(leaps_.count()) +
           " times as no vehicle can turn (an error of its estimate): these turns were left out");
}

}  // namespace swiftlet
