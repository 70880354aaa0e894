// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <cstddef>
#include <deque>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "core/backend/config/backend_config.hpp"
#include "core/backend/loop_closing/cross_check.hpp"
#include "core/backend/loop_closing/loop_closure.hpp"
#include "core/backend/loop_closing/return_evidence.hpp"
#include "core/backend/loop_closing/submap.hpp"
#include "core/backend/pose_graph/pose_graph.hpp"
#include "core/backend/store/keyframe_chain.hpp"
#include "core/base/time.hpp"

namespace swiftlet {

/// Why travel may lie elsewhere in the map than the graph has it.
struct MotionBreak {
  Duration unwatched{};                ///< the vehicle may have been carried for so long
  std::optional<KeyframeId> moved_at;  ///< its estimate ran on, and it moved here by more than that
  double log_odds_moved = 0.0;         ///< evidence that it did
  bool estimate_ran_on = false;        ///< nothing was received, but the estimate gives the way
};

/// Where travel after a break may lie in the map. Each hypothesis is one place of the whole travel. The scans
/// on the way are evidence for or against each: hits on walls of earlier submaps there, and hits in their
/// free space. Unknown ground is no evidence. A hypothesis is accepted once it is so much likelier than every
/// other, and than a place outside of the map, that one decision in a thousand would be wrong. What is seen
/// next may still refute it. Views its arguments, which must outlive it. One thread at a time; allocates.
class PlaceHypotheses {
 public:
  PlaceHypotheses(const BackendConfig& config, const ScanStore& scans, const KeyframeChain& chain)
      : config_(&config), scans_(&scans), chain_(&chain), returns_(config.tuning.confidence, scans) {}

  /// Starts anew: the first query begins with one hypothesis, that the travel lies where the graph puts it.
  void begin(const MotionBreak& motion_break);
  /// Goes on after the graph was corrected without them: where it has the travel now is one more place.
  void resume() { is_graph_corrected_ = true; }
  /// Starts anew with the same break; of `pruned` keyframes `moved_at` goes back to the nearest that stays.
  void begin_again(const IdRanges<KeyframeId>& pruned = {});
  /// The travel up to `query`, of scans `recent`, is evidence, if there is enough new travel in it.
  /// `submaps`: those of before. `T_path_keyframe`: the travel, in any frame; a place moves it as a whole.
  /// Returns whether it was taken.
  bool add_query(KeyframeId query, const ScanRange& recent,
                 std::span<const std::shared_ptr<const Submap>> submaps, const PoseGraph& graph,
                 const KeyframePoses& T_local_keyframe, const KeyframePoses& T_path_keyframe);
  /// A match of the travel with a submap is another hypothesis, unless it is one of them already.
  void propose(const LoopClosure& match, std::span<const std::shared_ptr<const Submap>> submaps,
               const PoseGraph& graph, const KeyframePoses& T_path_keyframe);
  /// Matches of the newest query with the vehicle turned in place at the break, by any angle up to a quarter.
  [[nodiscard]] std::vector<LoopClosure> turned(std::span<const std::shared_ptr<const Submap>> submaps,
                                                const PoseGraph& graph, const KeyframePoses& T_path_keyframe);
  /// The matches of the likeliest hypothesis, one for each query that shows known walls; empty while it
  /// cannot be accepted, or if it is the one that was.
  [[nodiscard]] std::vector<LoopClosure> decided() const;
  /// The likeliest was accepted: from now on it lies where the graph has the travel. `T_path_keyframe` of
  /// later queries must not follow it there. Precondition of this and is_beyond_doubt(): there is one.
  void accept_likeliest();
  /// The evidence against the accepted one is as much as a decision takes, or it is not weighed any more.
  [[nodiscard]] bool is_refuted() const;
  /// The accepted one leads by the evidence for two decisions.
  [[nodiscard]] bool is_beyond_doubt() const;
  [[nodiscard]] std::size_t size() const { return hypotheses_.size(); }
  /// Log-odds of the likeliest, over the next and over ground that the map does not show. Precondition: one.
  [[nodiscard]] double lead() const;

 private:
  struct Query {
    KeyframeId id{};
    double yaw_local_rad = 0.0;
    std::vector<Point2> points;
    CrossCheck cross_check;
    double reach_m = 0.0;               // of the points
    ScanRange newer{};                  // since the query before
    std::vector<Pose2> T_query_body{};  // of these
  };
  struct Hypothesis {
    Pose2 T_map_path;
    double log_odds = 0.0;                // prior and evidence; of forgotten queries less the likeliest's
    std::vector<double> log_likelihoods;  // by query
    std::vector<LoopClosure> matches;     // with the queries that show known walls
    bool is_accepted = false;
  };
  struct Evidence {
    double log_likelihood = 0.0;
    std::optional<LoopClosure> match;
  };
  [[nodiscard]] Evidence evidence(Query& query, const Pose2& T_map_query,
                                  std::span<const std::shared_ptr<const Submap>> submaps,
                                  const PoseGraph& graph) const;
  void weigh(Query& query, std::span<const std::shared_ptr<const Submap>> submaps, const PoseGraph& graph,
             const KeyframePoses& T_path_keyframe, Hypothesis& hypothesis) const;
  [[nodiscard]] Hypothesis weighed_over_all(const Pose2& T_map_path, double prior,
                                            std::span<const std::shared_ptr<const Submap>> submaps,
                                            const PoseGraph& graph, const KeyframePoses& T_path_keyframe);
  void merge(const Pose2& T_path_query);
  void forget_oldest();
  [[nodiscard]] double log_prior(const Pose2& T_map_path, KeyframeId query, double drift_m,
                                 std::size_t submaps, const PoseGraph& graph,
                                 const KeyframePoses& T_path_keyframe) const;
  [[nodiscard]] double drift_m(const LoopClosure& match, const PoseGraph& graph) const;
  [[nodiscard]] double against(const Query& query, const Pose2& T_map_query,
                               std::span<const std::shared_ptr<const Submap>> submaps,
                               const PoseGraph& graph) const;
  [[nodiscard]] double likelihood_per_excess() const;
  [[nodiscard]] double queries_alike() const;
  [[nodiscard]] double sigma_m(const Hypothesis& hypothesis) const;

  const BackendConfig* config_;
  const ScanStore* scans_;
  const KeyframeChain* chain_;
  ReturnEvidence returns_;
  MotionBreak break_;
  bool is_graph_corrected_ = false;  // since the last query
  std::deque<Query> queries_;
  std::vector<Hypothesis> hypotheses_;
};

}  // namespace swiftlet
