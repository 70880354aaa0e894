// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "firmware_link/sample/sign_mending_source.hpp"

#include <cstdio>
#include <string>

namespace swiftlet {

Result<ReceivedSample> SignMendingSource::next() {
  for (;;) {
    if (const std::optional<RangeSample> sample = signs_.take()) return ReceivedSample{.sample = *sample};
    if (outcome_) return *outcome_;
    const Result<ReceivedSample> received = recording_->next();
    if (received) {
      signs_.add(received->sample);
    } else if (received.error().code == ErrorCode::kTimeout) {
      return received.error();
    } else {
      outcome_ = received.error();
      signs_.end();
    }
  }
}

void SignMendingSource::end() {
  recording_->end();
  report_ = recording_->report();
  report_.reversed_m = signs_.reversed_m();
  ended_ = true;
  if (signs_.mended().empty()) return;
  char way[32];
  std::snprintf(way, sizeof way, "%.1f m", report_.reversed_m);
  report_.notes.push_back(std::string("the odometry reports reverse driving as forward: ") + way +
                          " taken as driven in reverse, as the ranges show");
}

}  // namespace swiftlet
