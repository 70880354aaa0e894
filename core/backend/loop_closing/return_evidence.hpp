// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "core/backend/config/backend_tuning.hpp"
#include "core/backend/loop_closing/submap.hpp"
#include "core/backend/store/scan_store.hpp"

namespace swiftlet {

/// What one return contributes about the pose it was seen from.
enum class ReturnVerdict : std::uint8_t {
  kUnknown,      ///< ground that no earlier submap knows
  kAgrees,       ///< near a wall of an earlier submap
  kContradicts,  ///< in what was seen free, or behind a wall
};

/// A submap that the returns of a scan may lie on.
struct SubmapAround {
  std::shared_ptr<const Submap> submap;
  Pose2 T_submap_map;
};

/// What returns say about the pose they were seen from: whether they agree with earlier submaps, and how much
/// likelier the share of contradictions is where the pose is off by half a metre or more than where it is
/// right. Scans count by travel: a person who stands before a hovering vehicle is one. Views its arguments,
/// which must outlive it. Any thread; allocates.
class ReturnEvidence {
 public:
  ReturnEvidence(const ConfidenceTuning& tuning, const ScanStore& scans) : tuning_(&tuning), scans_(&scans) {}

  /// Those of `submaps` around `T_map_body`, on that storey, that ended by `ended_by_m` of the path.
  [[nodiscard]] std::vector<SubmapAround> around(const Pose2& T_map_body, double ended_by_m, StoreyId storey,
                                                 std::span<const std::shared_ptr<const Submap>> submaps,
                                                 const KeyframePoses& T_map_keyframe) const;
  /// Whether a scan counts after the one that counted last.
  [[nodiscard]] bool is_farther_on(const Pose2& T_map_compared, const Pose2& T_map_body) const;
  [[nodiscard]] double weight_of(std::span<const ScanReturn> returns) const;
  [[nodiscard]] ReturnVerdict verdict(std::span<const SubmapAround> around, const Pose2& T_map_body,
                                      const ScanReturn& beam) const;
  /// Of the pose being off rather than right.
  [[nodiscard]] double log_odds_of(ReturnVerdict verdict) const;
  /// Their sum over all returns of `scans`, seen from `T_map_body`, one pose per scan, against those of
  /// `submaps` that ended `older_by_m` of travel or more before each. `T_map_keyframe`: of the submaps.
  [[nodiscard]] double against(const ScanRange& scans, std::span<const Pose2> T_map_body, double older_by_m,
                               std::span<const std::shared_ptr<const Submap>> submaps,
                               const KeyframePoses& T_map_keyframe) const;

 private:
  const ConfidenceTuning* tuning_;
  const ScanStore* scans_;
};

}  // namespace swiftlet
