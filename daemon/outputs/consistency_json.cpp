// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "daemon/outputs/consistency_json.hpp"

#include <nlohmann/json.hpp>

namespace swiftlet {

nlohmann::ordered_json consistency_json(const RunConsistency& consistency) {
  using Json = nlohmann::ordered_json;
  Json after = Json::array();
  for (const std::optional<ConsistencyAt>& at : consistency.at) {
    if (!at) continue;
    after.push_back({{"path_m", at->path_m},
                     {"nees", at->nees},
                     {"error_m", at->error_m},
                     {"sigma_m", at->sigma_m},
                     {"error_yaw_rad", at->error_yaw_rad},
                     {"sigma_yaw_rad", at->sigma_yaw_rad}});
  }
  const AlarmCounts& alarms = consistency.alarms;
  return {{"after", after},
          {"seconds", alarms.seconds},
          {"seconds_doubted", alarms.seconds_doubted},
          {"alarms", alarms.alarms},
          {"false_alarms", alarms.false_alarms},
          {"unjudged_alarms", alarms.unjudged_alarms},
          {"times_off", alarms.times_off},
          {"noticed_s", alarms.noticed_s}};
}

}  // namespace swiftlet
