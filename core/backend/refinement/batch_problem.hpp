// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "core/backend/config/backend_config.hpp"
#include "core/backend/pose_graph/pose_graph.hpp"
#include "core/backend/pose_graph/pose_system.hpp"
#include "core/backend/refinement/doubted_motion.hpp"
#include "core/backend/refinement/refinement_problem.hpp"
#include "core/backend/store/scan_store.hpp"
#include "core/base/result.hpp"
#include "core/sensing/sensor_model.hpp"

namespace swiftlet {

/// The dead reckoning that joins neighbouring scans.
enum class DeadReckoning : std::uint8_t {
  kLessDrift,   ///< StoredScan::T_dead_body
  kAsReported,  ///< StoredScan::T_odom_body with SensorModel::calibration_as_reported()
};

/// What the poses of consecutive scans are refined by. Views all of it.
struct BatchRefinement {
  const ScanStore& scans;
  const SensorModel& sensor;
  std::span<const RelativePoseFactor<ScanId>> closures{};  ///< information scaled by DCS already
  std::span<const HeadingFactor<ScanId>> headings{};       ///< likewise
  std::span<const DoubtedMotion> doubted{};
  const BackendConfig& config;
  DeadReckoning dead_reckoning = DeadReckoning::kLessDrift;
  std::span<const double> step_scale{};  ///< FloorFindings'; empty: steps are as long as that says
  ScanRange range{};                     ///< closures and headings lie in it; empty: all scans
  std::size_t max_returns = std::numeric_limits<std::size_t>::max();  ///< of more, every n-th counts

  [[nodiscard]] ScanRange scan_range() const {
    return range.empty() ? ScanRange{scans.all().first_id(), scans.all().end_id()} : range;
  }
  /// In order; as long as no scan is added or erased.
  [[nodiscard]] std::span<const StoredScan> stored() const { return scans.all().values(scan_range()); }
};

/// The same as lists over poses, one for each scan, numbered from the first. Allocates. One thread at a time.
class BatchProblem {
 public:
  using Factor = RelativePoseFactor<PoseIndex>;
  using Heading = HeadingFactor<PoseIndex>;

  /// Copies what it needs.
  explicit BatchProblem(const BatchRefinement& batch);

  [[nodiscard]] const RefinementProblem& hits() const { return hits_; }
  /// Dead reckoning from each scan to the next, then closures.
  [[nodiscard]] const std::vector<Factor>& factors() const { return factors_; }
  [[nodiscard]] std::span<const Factor> motions() const { return std::span(factors_).first(poses_ - 1); }
  [[nodiscard]] std::span<const Heading> headings() const { return headings_; }
  /// Draws the walls at these poses, then takes one Gauss-Newton step of the poses, but for the first.
  /// `radius_m`: how far from a return its wall may lie. Errors: kSolver; the poses are then as they were.
  Status take_round(double radius_m, std::vector<Pose2>& T_map_body);

 private:
  std::size_t poses_ = 0;
  RefinementProblem hits_;
  std::vector<Factor> factors_;
  std::vector<Heading> headings_;
  PoseSystem system_;
  bool is_prepared_ = false;
};

}  // namespace swiftlet
