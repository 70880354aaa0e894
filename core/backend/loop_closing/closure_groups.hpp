// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "core/backend/config/backend_config.hpp"
#include "core/backend/loop_closing/loop_closure.hpp"
#include "core/backend/pose_graph/pose_graph.hpp"
#include "core/backend/store/keyframe_chain.hpp"

namespace swiftlet {

/// Tentative matches, each too weak to close a loop alone, wait here until enough of them, over enough
/// travel, agree.
///
/// Two agree when the loop of both and of the travel between their ends closes, by chi-square (Mangelson et
/// al. 2018, "Pairwise consistent measurement set maximization for robust multi-robot map merging", eq. 5;
/// here of one vehicle with its own past). A set in which all agree is accepted once it is large, fixes the
/// position in every direction, and no other set is nearly as large (Olson et al. 2005, "Single-cluster
/// graph partitioning for robotics applications": a second best half as good is ambiguity). One thread at a
/// time. Allocates; what waits is bounded.
class ClosureGroups {
 public:
  /// Views `chain`, which must outlive it.
  explicit ClosureGroups(const KeyframeChain& chain, const BackendConfig& config = {})
      : chain_(&chain),
        tuning_(config.tuning.groups),
        covariance_tuning_(config.tuning.covariance),
        multiscan_length_m_(config.multiscan_length_m) {}

  /// Adds what was found from one keyframe, the newest. Returns the group that is now accepted, mostly none.
  /// Then all that waited is forgotten: a group is returned once.
  std::vector<LoopClosure> add(std::span<const LoopClosure> found, const PoseGraph& graph);
  /// Forgets all that waits: keyframes are pruned.
  void clear() { waiting_.clear(); }

  [[nodiscard]] std::size_t waiting() const { return waiting_.size(); }

 private:
  struct Waiting {
    LoopClosure closure;
    std::vector<std::size_t> agreeing;  ///< ascending indices into waiting_
  };

  void forget_before(double path_m);
  void admit(const LoopClosure& closure, const PoseGraph& graph,
             const IdMap<KeyframeId, Eigen::Matrix3d>& covariances_query);
  [[nodiscard]] std::vector<std::size_t> agreeing_set(std::size_t seed) const;
  [[nodiscard]] Eigen::Matrix2d information_without(std::size_t left_out, std::span<const std::size_t> set,
                                                    const PoseGraph& graph) const;
  [[nodiscard]] bool is_conclusive(std::span<const std::size_t> set, const PoseGraph& graph) const;
  [[nodiscard]] std::size_t largest_rival(std::span<const std::size_t> set) const;

  const KeyframeChain* chain_;
  ClosureGroupTuning tuning_;
  RelativeCovarianceTuning covariance_tuning_;
  double multiscan_length_m_;     // queries so far apart have no scan in common
  std::vector<Waiting> waiting_;  // in the order found
};

}  // namespace swiftlet
