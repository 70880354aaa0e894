// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "daemon/outputs/consistency_json.hpp"
#include "daemon/outputs/known_place_json.hpp"
#include "tools/evaluation/live_evaluation.hpp"

namespace swiftlet {
namespace {

using Json = nlohmann::ordered_json;

std::string consistency_text(const RunConsistency& consistency) {
  std::string text;
  for (const std::optional<ConsistencyAt>& at : consistency.at)
    if (at)
      text += fmt::format(
          "  after {:.0f} m: off by {:.3f} m and {:.3f} rad, standard deviations {:.3f} m and {:.3f} rad, "
          "NEES "
          "{:.2f} (3 on average where they are right)\n",
          at->path_m, at->error_m, at->error_yaw_rad, at->sigma_m, at->sigma_yaw_rad, at->nees);
  const AlarmCounts& alarms = consistency.alarms;
  return text +
         fmt::format("  in doubt {} times, {:.1f} % of the time; {} times while off by less than {} m\n",
                     alarms.alarms, 100.0 * alarms.seconds_doubted / std::max(1.0, alarms.seconds),
                     alarms.false_alarms, AlarmTuning{}.right_m);
}

/// In the worst direction: the square root of the greater eigenvalue.
double position_sigma_m(const Covariance3& P) {
  const double mean = 0.5 * (P.xx + P.yy);
  return std::sqrt(mean + std::hypot(0.5 * (P.xx - P.yy), P.xy));
}

std::string number(const std::optional<double>& value) {
  return value ? fmt::format("{:.3f}", *value) : "unknown";
}

}  // namespace

std::string live_evaluation_text(const LiveEvaluation& evaluation) {
  const KnownPlaceError& live = evaluation.live;
  const KnownPlaceTuning tuning;
  std::string text = fmt::format("{}: {} poses at known places\n", evaluation.input, live.moments);
  text +=
      fmt::format("  error, m: rms {:.3f}, p95 {:.3f}, max {:.3f}; beyond {} m for {:.1f} % of the time\n",
                  live.rms_m, live.p95_m, live.max_m, tuning.off_m, 100.0 * live.share_off);
  text += fmt::format("  p95 across the nearest wall {} m, along it {} m\n", number(live.across_p95_m),
                      number(live.along_p95_m));
  text +=
      fmt::format("  contacts with old ground: {}, off at first: {}, those below {} m after {:.1f} s (p50)\n",
                  live.contacts, live.contacts_off, tuning.settled_m, live.settled_p50_s);
  text += fmt::format("  jumps beyond {} m: {}, greatest {:.3f} m\n", tuning.off_m, live.jumps,
                      live.greatest_jump_m);
  for (std::size_t i = 0; i < live.map_rms_m.size(); ++i)
    text += fmt::format("  old ground {} m away: off by {} m (rms)\n", tuning.distances_m[i],
                        number(live.map_rms_m[i]));
  text += consistency_text(evaluation.consistency);
  if (evaluation.batch)
    text += fmt::format(
        "  runs that end at {} of the poses: rms {:.3f} m, beyond {} m {:.1f} %; live there {:.3f} m, {:.1f} "
        "%\n",
        evaluation.batch->moments, evaluation.batch->rms_m, tuning.off_m, 100.0 * evaluation.batch->share_off,
        evaluation.batch->live_rms_m, 100.0 * evaluation.batch->live_share_off);
  return text;
}

std::string live_evaluation_json(const LiveEvaluation& evaluation) {
  Json json{{"input", evaluation.input}, {"live", known_place_json(evaluation.live)}};
  Json& errors = json["live"]["errors_m"] = Json::array();
  for (const StampedError& at : evaluation.live.errors)
    errors.push_back({to_seconds(at.stamp.time_since_epoch()), at.error_m});
  json["consistency"] = consistency_json(evaluation.consistency);
  Json& poses = json["poses"] = Json::array();
  for (const DoubtedPose& pose : evaluation.poses)
    poses.push_back({to_seconds(pose.stamp.time_since_epoch()), pose.T_map_body.x_m(), pose.T_map_body.y_m(),
                     pose.T_map_body.yaw_rad(), position_sigma_m(pose.from_start),
                     position_sigma_m(pose.from_surroundings), pose.state});
  if (evaluation.batch)
    json["batch"] = {{"moments", evaluation.batch->moments},
                     {"rms_m", evaluation.batch->rms_m},
                     {"share_off", evaluation.batch->share_off},
                     {"live_rms_m", evaluation.batch->live_rms_m},
                     {"live_share_off", evaluation.batch->live_share_off}};
  // Names of files may hold any bytes: what is not UTF-8 is replaced.
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace swiftlet
