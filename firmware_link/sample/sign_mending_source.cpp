// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "firmware_link/sample/sign_mending_source.hpp"

#include <cstdio>
#include <string>

namespace swiftlet {

void SignMendingSource::keep_reading() {
  const InputReport& now = inner().report();
  readings_.push_back({now.counters, now.problems.size(), inner().progress()});
}

void SignMendingSource::report_next_reading() {
  const Reading& reading = readings_.front();
  report_.counters = reading.counters;
  while (report_.problems.size() < reading.problems)
    report_.problems.push_back(inner().report().problems[report_.problems.size()]);
  progress_ = reading.progress;
  readings_.pop_front();
}

Result<ReceivedSample> SignMendingSource::next() {
  for (;;) {
    if (const std::optional<RangeSample> sample = signs_.take()) {
      report_next_reading();
      return ReceivedSample{.sample = *sample};
    }
    if (outcome_) {
      report_ = inner().report();
      progress_ = inner().progress();
      return *outcome_;
    }
    const Result<ReceivedSample> received = inner().next();
    if (received) {
      signs_.add(received->sample);
      keep_reading();
    } else if (received.error().code == ErrorCode::kTimeout) {
      return received.error();
    } else {
      outcome_ = received.error();
      signs_.end();
    }
  }
}

void SignMendingSource::end() {
  inner().end();
  report_ = inner().report();
  report_.reversed_m = signs_.reversed_m();
  if (signs_.mended().empty()) return;
  char way[32];
  std::snprintf(way, sizeof way, "%.1f m", report_.reversed_m);
  report_.notes.push_back(std::string("the odometry reports reverse driving as forward: ") + way +
                          " taken as driven in reverse, as the ranges show");
}

}  // namespace swiftlet
