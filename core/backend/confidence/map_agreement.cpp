// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "core/backend/confidence/map_agreement.hpp"

#include <algorithm>

namespace swiftlet {

void MapAgreement::look_around(const Pose2& T_map_body, double path_m, StoreyId storey,
                               std::span<const std::shared_ptr<const Submap>> submaps,
                               const KeyframePoses& T_map_keyframe) {
  around_ = returns_.around(T_map_body, path_m - tuning_->old_after_m, storey, submaps, T_map_keyframe);
}

void MapAgreement::add_newest_scan(const Pose2& T_map_body) {
  if (log_odds_ <= 0.0) agreed_last_ = scans_->all().last_id();
  if (around_.empty()) return;
  if (!returns_.is_farther_on(T_map_compared_, T_map_body)) return;
  T_map_compared_ = T_map_body;
  const std::span<const ScanReturn> returns = scans_->returns(scans_->all().last_id());
  for (const ScanReturn& beam : returns)
    if (beam.is_hit) weigh(returns_.verdict(around_, T_map_body, beam), returns_.weight_of(returns));
}

void MapAgreement::weigh(ReturnVerdict verdict, double weight) {
  if (verdict == ReturnVerdict::kUnknown) return;
  const bool contradicts = verdict == ReturnVerdict::kContradicts;
  if (!contradicts) agreed_at_m_ = scans_->all().values().back().path_m;
  ++returns_compared_;
  share_ += ((contradicts ? 1.0 : 0.0) - share_) / tuning_->recent_returns;
  log_odds_ += weight * returns_.log_odds_of(verdict);
  log_odds_ = std::clamp(log_odds_, 0.0, tuning_->alarm_log_odds);
  if (log_odds_ <= 0.0) is_contradicted_ = false;
  if (log_odds_ >= tuning_->alarm_log_odds && !is_contradicted_) {
    is_contradicted_ = true;
    ++times_contradicted_;
  }
}

void MapAgreement::begin_again() {
  log_odds_ = 0.0;
  share_ = 0.0;
  is_contradicted_ = false;
}

}  // namespace swiftlet
