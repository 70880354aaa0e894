// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "firmware_link/sample/motion_mending_source.hpp"

#include <cstdint>
#include <string>

namespace swiftlet {

Result<ReceivedSample> MotionMendingSource::next() {
  Result<ReceivedSample> received = inner().next();
  if (!received) return received;
  restarts_.mend(received->sample);
  leaps_.mend(received->sample);
  return received;
}

std::optional<VehicleEvent> MotionMendingSource::take_event() {
  if (leaps_told_ == leaps_.count()) return inner().take_event();
  leaps_told_ = leaps_.count();
  return VehicleEvent{VehicleEvent::Kind::kHeadingLeapt, static_cast<std::int32_t>(leaps_told_)};
}

void MotionMendingSource::end() {
  ForwardingSource::end();
  if (restarts_.count() > 0)
    add_note("the vehicle's estimate restarted " + std::to_string(restarts_.count()) +
             " times in flight: it was taken to fly on as before for that moment");
  if (leaps_.count() == 0) return;
  add_note("the heading of the dead reckoning leaps " + std::to_string(leaps_.count()) +
           " times as no vehicle can turn (an error of its estimate): these turns were left out");
}

}  // namespace swiftlet
