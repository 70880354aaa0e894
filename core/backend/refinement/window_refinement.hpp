// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/backend/pose_graph/pose_chain.hpp"
#include "core/backend/refinement/doubted_motion.hpp"
#include "core/backend/refinement/refinement_problem.hpp"
#include "core/backend/store/scan_store.hpp"
#include "core/base/result.hpp"
#include "core/sensing/sensor_model.hpp"

namespace swiftlet {

struct WindowReport : HeldOutVerdict {
  std::size_t returns = 0;  ///< that took part, held-out ones included
  std::size_t points = 0;   ///< that walls were fitted to
};

/// Poses of a window's scans and of the one before it, which is held.
struct WindowPoses {
  ScanRange scans;                  ///< the window with the scan before it, if there is one
  std::vector<Pose2> T_map_body;    ///< as refined so far: in and out; the first is held
  std::vector<Pose2> T_map_graph;   ///< where the pose graph puts them
  std::vector<Pose2> T_local_body;  ///< along the frontend's path, which gives the steps between them
  std::span<const DoubtedMotion> doubted{};
};

/// One Gauss-Newton step of joint refinement over a window of consecutive scans: point-to-line factors to the
/// walls of other traversals, the frontend's path between neighbouring scans, and for each keyframe a weak
/// factor to its pose in the graph. Views the scans, which must outlive it. Allocates. One thread at a time.
/// Repeatable.
class WindowRefinement {
 public:
  WindowRefinement(const ScanStore& scans, const OdometryNoise& noise, const RefinementTuning& tuning = {})
      : scans_(&scans), noise_(noise), tuning_(tuning), problem_(tuning) {}

  /// `others`: points nearby of traversals outside of the window, ordered by traversal, on the storey of the
  /// window's first scan. Errors: kSolver; the poses are then as they were.
  Result<WindowReport> refine(const ScanRange& window, std::span<const TraversalPoint> others,
                              WindowPoses& poses);

 private:
  void take_returns(const ScanRange& window, std::size_t first_pose);
  void take_steps(const WindowPoses& poses);
  void add_ties(const WindowPoses& poses);

  const ScanStore* scans_;
  OdometryNoise noise_;
  RefinementTuning tuning_;
  PoseChain chain_;
  RefinementProblem problem_;
  std::vector<RelativePoseFactor<PoseIndex>> steps_;  // from each pose to the next
};

}  // namespace swiftlet
