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

std::string growth_text(const char* what, std::uint64_t before, std::uint64_t now) {
  return fmt::format("{}: {} more, {} in all", what, now - before, now);
}

void log_if_grown(spdlog::level::level_enum level, const char* what, std::uint64_t before,
                  std::uint64_t now) {
  if (now > before) spdlog::log(level, "{}", growth_text(what, before, now));
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

std::vector<InputNews> input_news(const InputStatus& before, const InputStatus& now) {
  std::vector<InputNews> news;
  const LinkCondition condition = now.live.link.condition;
  if (condition != before.live.link.condition)
    news.push_back({condition != LinkCondition::kConnected, "link: " + std::string(describe(condition))});
  const auto warn_if_grown = [&news](const char* what, std::uint64_t was, std::uint64_t is) {
    if (is > was) news.push_back({true, growth_text(what, was, is)});
  };
  const SharingCounters& sharing_before = before.live.sharing.counters;
  const SharingCounters& sharing = now.live.sharing.counters;
  warn_if_grown("input: holes in the ranges", before.counters.gaps, now.counters.gaps);
  warn_if_grown("client: setpoints dropped (vehicle not received, or more than the link carries)",
                sharing_before.steering_dropped, sharing.steering_dropped);
  warn_if_grown("client: requests dropped (more than the link carries)", sharing_before.requests_dropped,
                sharing.requests_dropped);
  warn_if_grown("input: new segments (silence, restart or reset)",
                std::max<std::uint64_t>(before.counters.segments, 1), now.counters.segments);
  warn_if_grown("input: ranges left out, because the dead reckoning has run away (check the Flow deck)",
                before.counters.too_far, now.counters.too_far);
  return news;
}

std::optional<InputNews> tracking_news(const TrackingFigures& before, const TrackingFigures& now) {
  if (now.tracking == before.tracking) return std::nullopt;
  switch (now.tracking) {
    case Tracking::kTracking:
      return InputNews{false, "tracking: what is seen agrees with the map again"};
    case Tracking::kUncertain:
      return InputNews{
          true, fmt::format("tracking: uncertain, {:.0f} % of the last returns contradict the older map",
                            100.0 * now.contradicting_share)};
    case Tracking::kLost:
      return InputNews{true, "tracking: lost, the vehicle moved unwatched; fly where the map is known"};
    case Tracking::kRelocalizing:
      break;
  }
  return InputNews{false, fmt::format("tracking: {} places in the map are weighed", now.places_weighed)};
}

void log_changes(const DaemonStatus& before, const DaemonStatus& now) {
  using enum spdlog::level::level_enum;
  for (const InputNews& news : input_news(before.input, now.input))
    spdlog::log(news.is_warning ? warn : info, "{}", news.text);
  if (const std::optional<InputNews> news = tracking_news(before.tracking, now.tracking))
    spdlog::log(news->is_warning ? warn : info, "{}", news->text);
  log_if_grown(warn, "input: problems", before.input.problems, now.input.problems);
  log_if_grown(debug, "frontend: batches rolled back", before.frontend.batches_rolled_back,
               now.frontend.batches_rolled_back);
  log_if_grown(warn, "frontend: no room", before.frontend.refused_full, now.frontend.refused_full);
  log_if_grown(warn, "backend: solver failures", before.backend.solver_failures, now.backend.solver_failures);
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
