// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "daemon/status_log.hpp"

#include <spdlog/spdlog.h>

#include <cmath>

namespace swiftlet {
namespace {

void warn_if_grown(const char* what, std::uint64_t before, std::uint64_t now) {
  if (now > before) spdlog::warn("{}: {} more, {} in all", what, now - before, now);
}

}  // namespace

void log_changes(const DaemonStatus& before, const DaemonStatus& now) {
  warn_if_grown("input: holes in the ranges", before.input.gaps, now.input.gaps);
  warn_if_grown("input: problems", before.input.problems, now.input.problems);
  if (before.input.segments > 0)
    warn_if_grown("input: the dead reckoning began anew", before.input.segments, now.input.segments);
  warn_if_grown("frontend: batches rolled back", before.frontend.batches_rolled_back,
                now.frontend.batches_rolled_back);
  warn_if_grown("frontend: no room", before.frontend.refused_full, now.frontend.refused_full);
  warn_if_grown("backend: solver failures", before.backend.solver_failures, now.backend.solver_failures);
  for (std::size_t i = 0; i < now.queues.size(); ++i) {
    if (now.queues[i].refused > before.queues[i].refused)
      spdlog::warn("queue of {}: full, {} refused in all", now.queues[i].name, now.queues[i].refused);
  }
  spdlog::debug("{} samples ({:.1f} Hz), {} keyframes, {} submaps, {} closures, {} tiles", now.input.samples,
                now.sample_rate_hz, now.frontend.keyframes, now.backend.submaps,
                now.backend.closures_accepted, now.map.tiles);
}

void log_closure(const ClosureUpdate& update) {
  const LoopClosure& closure = update.closure;
  spdlog::debug("loop {} between keyframes {} and {}: {:.2f} m apart, score {:.2f}",
                closure.dropped ? "dropped" : "closed", index_of(closure.from), index_of(closure.to),
                std::hypot(closure.T_from_to.x_m(), closure.T_from_to.y_m()), closure.score);
}

}  // namespace swiftlet
