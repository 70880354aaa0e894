// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <vector>

#include "core/backend/refinement/batch_problem.hpp"
#include "core/backend/refinement/poses_and_walls.hpp"
#include "core/base/result.hpp"

namespace swiftlet {

/// The newest stretch of a run refined as a whole, in slices of bounded work: as the batch refinement does at
/// the end, walls and poses in turn with the wide radius, then once together. So what a loop closure leaves
/// over is spread over all of the loop, where a window of OnlineRefinement holds its beginning.
/// Allocates. One thread at a time. Repeatable.
class StretchRefinement {
 public:
  /// Offsets of scans from where the graph puts them.
  struct Found {
    ScanRange scans;
    std::vector<Pose2> T_graph_refined;
  };

  [[nodiscard]] bool is_busy() const { return job_ != nullptr; }
  /// Begins with poses by the graph. `T_graph_refined`: the offset of the first scan, which is held; what
  /// does not begin with the run is laid onto the graph as a whole. The store, sensor and settings of `batch`
  /// must outlive what is begun. Precondition: two scans.
  void begin(const BatchRefinement& batch, std::vector<Pose2> T_map_graph, const Pose2& T_graph_refined);
  /// The next slice, if any is left. Errors: kSolver; what was begun is given up then.
  Status step();
  /// Whether no slice is left.
  [[nodiscard]] bool is_solved() const { return job_ != nullptr && job_->is_solved; }
  /// Ends it. Nothing if held-out returns lie farther from the walls than by the graph. Precondition:
  /// is_solved().
  std::optional<Found> finish();
  /// Gives up what was begun: scans are erased.
  void abandon() { job_.reset(); }

 private:
  struct Job {
    Job(const BatchRefinement& what, std::vector<Pose2> T_map_begun, std::vector<Pose2> T_map_start);
    Status step();
    void lay_onto_graph();
    [[nodiscard]] double held_out_m(const std::vector<Pose2>& T_map) const;

    BatchRefinement batch;  // without what the problem has of it
    BatchProblem problem;
    std::vector<Pose2> T_map_graph;
    std::vector<Pose2> T_map_body;  // refined
    int rounds = 0;
    std::unique_ptr<PosesAndWalls> together;
    int steps = 0;
    bool is_solved = false;
  };

  std::unique_ptr<Job> job_;
};

}  // namespace swiftlet
