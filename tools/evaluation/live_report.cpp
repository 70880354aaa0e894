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
  return text + fmt::format(
                    "  in doubt {} times, {:.1f} % of the time; {} times while off by less than {} m, "
                    "{} times where no place was known\n",
                    alarms.alarms, 100.0 * alarms.seconds_doubted / std::max(1.0, alarms.seconds),
                    alarms.false_alarms, AlarmTuning{}.right_m, alarms.unjudged_alarms);
}

/// In the worst direction: the square root of the greater eigenvalue.
double position_sigma_m(const Covariance3& P) {
  const double mean = 0.5 * (P.xx + P.yy);
  return std::sqrt(mean + std::hypot(0.5 * (P.xx - P.yy), P.xy));
}

std::string number(const std::optional<double>& value, int digits = 3) {
  return value ? fmt::format("{:.{}f}", *value, digits) : "unknown";
}

/// A figure of so many moments: of none it is unknown, not 0.
std::optional<double> known_of(std::size_t moments, double figure) {
  return moments > 0 ? std::optional(figure) : std::nullopt;
}

std::string batch_text(const BatchError& batch) {
  const auto rms = [&](double rms_m) { return number(known_of(batch.moments, rms_m)); };
  const auto percent = [&](double share) { return number(known_of(batch.moments, 100.0 * share), 1); };
  return fmt::format(
      "  runs that end at {} of the poses: rms {} m, beyond {} m {} %; live there {} m, {} %\n",
      batch.moments, rms(batch.rms_m), KnownPlaceTuning{}.off_m, percent(batch.share_off),
      rms(batch.live_rms_m), percent(batch.live_share_off));
}

Json number_or_null(const std::optional<double>& value) { return value ? Json(*value) : Json(nullptr); }

Json batch_json(const BatchError& batch) {
  const auto known = [&](double figure) { return number_or_null(known_of(batch.moments, figure)); };
  return {{"moments", batch.moments},
          {"rms_m", known(batch.rms_m)},
          {"share_off", known(batch.share_off)},
          {"live_rms_m", known(batch.live_rms_m)},
          {"live_share_off", known(batch.live_share_off)}};
}

Json live_json(const KnownPlaceError& live) {
  Json json = known_place_json(live);
  Json& errors = json["errors_m"] = Json::array();
  for (const StampedError& at : live.errors)
    errors.push_back({to_seconds(at.stamp.time_since_epoch()), at.error_m});
  json["across_m"] = live.across_m;
  json["along_m"] = live.along_m;
  json["settled_s"] = live.settled_s;
  return json;
}

}  // namespace

std::string live_evaluation_text(const LiveEvaluation& evaluation) {
  const KnownPlaceError& live = evaluation.live;
  const KnownPlaceTuning tuning;
  std::string text = fmt::format("{}: {} poses at known places\n", evaluation.input, live.moments);
  const auto error = [&](double figure_m) { return number(known_of(live.moments, figure_m)); };
  text += fmt::format("  error, m: rms {}, p95 {}, max {}; beyond {} m for {} % of the time\n",
                      error(live.rms_m), error(live.p95_m), error(live.max_m), tuning.off_m,
                      number(known_of(live.moments, 100.0 * live.share_off), 1));
  text += fmt::format("  p95 across the nearest wall {} m, along it {} m\n", number(live.across_p95_m),
                      number(live.along_p95_m));
  text += fmt::format("  contacts with old ground: {}, off at first: {}, those below {} m after {} s (p50)\n",
                      live.contacts, live.contacts_off, tuning.settled_m,
                      number(known_of(live.contacts_off, live.settled_p50_s), 1));
  text += fmt::format("  jumps beyond {} m: {}, greatest {:.3f} m\n", tuning.off_m, live.jumps,
                      live.greatest_jump_m);
  for (std::size_t i = 0; i < live.map_rms_m.size(); ++i)
    text += fmt::format("  old ground {} m away: off by {} m (rms)\n", tuning.distances_m[i],
                        number(live.map_rms_m[i]));
  text += consistency_text(evaluation.consistency);
  if (evaluation.batch) text += batch_text(*evaluation.batch);
  return text;
}

std::string live_evaluation_json(const LiveEvaluation& evaluation) {
  Json json{{"input", evaluation.input},
            {"problems", evaluation.report.problems},
            {"live", live_json(evaluation.live)}};
  json["consistency"] = consistency_json(evaluation.consistency);
  Json& poses = json["poses"] = Json::array();
  for (const DoubtedPose& pose : evaluation.poses)
    poses.push_back({to_seconds(pose.stamp.time_since_epoch()), pose.T_map_body.x_m(), pose.T_map_body.y_m(),
                     pose.T_map_body.yaw_rad(), position_sigma_m(pose.from_start),
                     position_sigma_m(pose.from_surroundings), pose.state});
  if (evaluation.batch) json["batch"] = batch_json(*evaluation.batch);
  // Names of files may hold any bytes: what is not UTF-8 is replaced.
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace swiftlet
