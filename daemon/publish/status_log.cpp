// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "daemon/publish/status_log.hpp"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

#include "firmware_link/link/link_condition.hpp"

namespace swiftlet {
namespace {

void warn_if_grown(const char* what, std::uint64_t before, std::uint64_t now) {
  if (now > before) spdlog::warn("{}: {} more, {} in all", what, now - before, now);
}

void log_link(const LinkStatistics& before, const LinkStatistics& now) {
  if (now.condition == before.condition) return;
  const bool is_well = now.condition == LinkCondition::kConnected;
  spdlog::log(is_well ? spdlog::level::info : spdlog::level::warn, "link: {}", describe(now.condition));
}

std::string link_text(const DaemonStatus& status) {
  const LiveStatus& live = status.input.live;
  if (live.link.condition == LinkCondition::kNone) return {};
  const double round_trip_ms = to_seconds(live.round_trip) * 1e3;
  const std::optional<int> battery_mv = live.vehicle.battery_mv;
  return fmt::format("; link {:.0f} % acknowledged, {:.0f} packets/s, round trip {:.1f} ms{}",
                     std::max(0.0, status.link_rates.ack_rate) * 100.0, status.link_rates.received_hz,
                     round_trip_ms, battery_mv ? fmt::format(", {} mV", *battery_mv) : "");
}

}  // namespace

std::string status_text(const DaemonStatus& status) {
  return fmt::format("{} samples ({:.1f} Hz), {} keyframes, {} submaps, {} closures, {} tiles{}",
                     status.input.counters.samples, status.sample_rate_hz, status.frontend.keyframes,
                     status.backend.submaps, status.backend.closures_accepted, status.map.tiles,
                     link_text(status));
}

void log_changes(const DaemonStatus& before, const DaemonStatus& now) {
  log_link(before.input.live.link, now.input.live.link);
  const InputCounters& counters = now.input.counters;
  const InputCounters& counters_before = before.input.counters;
  warn_if_grown("input: holes in the ranges", counters_before.gaps, counters.gaps);
  const SharingCounters& sharing = now.input.live.sharing.counters;
  const SharingCounters& sharing_before = before.input.live.sharing.counters;
  warn_if_grown("client: setpoints dropped (vehicle not received, or more than the link carries)",
                sharing_before.steering_dropped, sharing.steering_dropped);
  warn_if_grown("client: requests dropped (more than the link carries)", sharing_before.requests_dropped,
                sharing.requests_dropped);
  warn_if_grown("input: problems", before.input.problems, now.input.problems);
  if (counters_before.segments > 0)
    warn_if_grown("input: new segments (silence, restart or reset)", counters_before.segments,
                  counters.segments);
  warn_if_grown("input: ranges left out, because the dead reckoning has run away (check the Flow deck)",
                counters_before.too_far, counters.too_far);
  warn_if_grown("frontend: batches rolled back", before.frontend.batches_rolled_back,
                now.frontend.batches_rolled_back);
  warn_if_grown("frontend: no room", before.frontend.refused_full, now.frontend.refused_full);
  warn_if_grown("backend: solver failures", before.backend.solver_failures, now.backend.solver_failures);
  for (std::size_t i = 0; i < now.queues.size(); ++i) {
    if (now.queues[i].refused > before.queues[i].refused)
      spdlog::warn("queue of {}: full, {} refused in all", now.queues[i].name, now.queues[i].refused);
  }
  spdlog::debug("{}", status_text(now));
}

void log_event(const VehicleEvent& event) {
  spdlog::log(is_warning(event) ? spdlog::level::warn : spdlog::level::info, "{}", describe(event));
}

void log_closure(const ClosureUpdate& update) {
  const LoopClosure& closure = update.closure;
  spdlog::debug("loop {} between keyframes {} and {}: {:.2f} m apart, score {:.2f}",
                closure.dropped ? "dropped" : "closed", index_of(closure.from), index_of(closure.to),
                std::hypot(closure.T_from_to.x_m(), closure.T_from_to.y_m()), closure.score);
}

}  // namespace swiftlet
