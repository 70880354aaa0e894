// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "daemon/publish/service_watch.hpp"

#include "daemon/publish/status_log.hpp"

namespace swiftlet {

void ServiceWatch::look(MonotonicTime now, const Progress& progress) {
  feed(now, progress);
  if (progress.statuses > statuses_told_) manager_.report_status(status_text(progress.status));
  statuses_told_ = progress.statuses;
  const bool stops = progress.input_is_over && !progress.is_followed;
  if (stops && !has_told_stopping_) manager_.report_stopping();
  has_told_stopping_ = stops;
}

void ServiceWatch::feed(MonotonicTime now, const Progress& progress) {
  if (!manager_.watchdog_period() || now - fed_at_ < *manager_.watchdog_period() / 3) return;
  if (progress.radio_steps == steps_when_fed_ && !progress.input_is_over) return;
  manager_.feed_watchdog();
  fed_at_ = now;
  steps_when_fed_ = progress.radio_steps;
}

}  // namespace swiftlet
