// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "core/backend/config/backend_tuning.hpp"
#include "core/backend/loop_closing/return_evidence.hpp"
#include "core/backend/loop_closing/submap.hpp"
#include "core/backend/store/scan_store.hpp"

namespace swiftlet {

/// Whether what is seen agrees with the map of long ago: CUSUM (Page 1954, "Continuous inspection schemes")
/// over the returns of the scans, between the share of contradictions when the pose is right and that when it
/// is off by half a metre or more. Scans count by travel: a person who stands before a hovering vehicle is
/// one. Views its arguments, which must outlive it. One thread at a time; allocates.
class MapAgreement {
 public:
  MapAgreement(const ConfidenceTuning& tuning, const ScanStore& scans)
      : tuning_(&tuning), scans_(&scans), returns_(tuning, scans) {}

  /// Takes the submaps that the next scans are compared with: those around `T_map_body`, on that storey, that
  /// ended long ago.
  void look_around(const Pose2& T_map_body, double path_m, StoreyId storey,
                   std::span<const std::shared_ptr<const Submap>> submaps,
                   const KeyframePoses& T_map_keyframe);
  /// Compares the newest scan.
  void add_newest_scan(const Pose2& T_map_body);
  /// The pose was corrected: what contradicted the old one is forgotten.
  void begin_again();

  /// Evidence against the pose: 0 none, 1 as much as a right pose collects once in an hour.
  [[nodiscard]] double contradiction() const { return log_odds_ / tuning_->alarm_log_odds; }
  /// From the evidence's reaching 1 until it is 0 again.
  [[nodiscard]] bool is_contradicted() const { return is_contradicted_; }
  /// Of the last scan before the evidence began to grow.
  [[nodiscard]] ScanId agreed_last() const { return agreed_last_; }
  /// How far the vehicle had travelled when a return agreed last; 0 before the first.
  [[nodiscard]] double agreed_at_m() const { return agreed_at_m_; }
  [[nodiscard]] double contradicting_share() const { return share_; }
  [[nodiscard]] std::uint64_t returns_compared() const { return returns_compared_; }
  [[nodiscard]] std::uint64_t times_contradicted() const { return times_contradicted_; }

 private:
  void weigh(ReturnVerdict verdict, double weight);

  const ConfidenceTuning* tuning_;
  const ScanStore* scans_;
  ReturnEvidence returns_;
  std::vector<SubmapAround> around_;
  Pose2 T_map_compared_;  // of the scan that was compared last
  double log_odds_ = 0.0;
  double share_ = 0.0;
  bool is_contradicted_ = false;
  ScanId agreed_last_{};
  double agreed_at_m_ = 0.0;
  std::uint64_t returns_compared_ = 0;
  std::uint64_t times_contradicted_ = 0;
};

}  // namespace swiftlet
