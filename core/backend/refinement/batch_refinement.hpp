// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <vector>

#include "core/backend/refinement/batch_problem.hpp"
#include "core/backend/refinement/floor_field.hpp"
#include "core/backend/refinement/refinement_problem.hpp"
#include "core/base/result.hpp"

namespace swiftlet {

struct RefinementReport : HeldOutVerdict {
  bool moved_walls = false;     ///< refine_together() was accepted, whatever the distance did
  double share_on_walls = 0.0;  ///< of the held-out returns: that lie on walls of other traversals
  /// By traversal, in order: minus the log likelihood of the poses returned, but for a constant. Of the
  /// held-out returns (distance over wall sigma) and of the dead reckoning (half the dcs_cost() of a step, so
  /// that one slip does not outweigh the rest). Comparable between starts of one run.
  std::vector<double> misfit;
  std::vector<double> misfit_at_start;
  /// What all held-out returns have of `misfit`, and dead_reckoning_misfit(). Of judge_as_it_is() only.
  double misfit_of_path = 0.0;
};

/// Refinement of every scan's pose: a sparse Gauss-Newton problem of point-to-line factors to the walls of
/// other traversals, dead reckoning between neighbouring scans, and accepted loop closures, of which walls
/// and poses are computed in turn. A tenth of the returns is held out: the result is accepted only if they
/// lie as close to their walls as at the start. The start must have its walls within about half a metre of
/// each other: refinement closes no loops. `T_map_body`: one pose per scan, in and out, the first one is
/// held. Errors: kSolver. Allocates. Repeatable.
Result<RefinementReport> refine_in_turn(const BatchRefinement& batch, std::vector<Pose2>& T_map_body);
/// Judges a path, by the same returns and dead reckoning, and leaves it alone. One pose per scan. Allocates.
RefinementReport judge_as_it_is(const BatchRefinement& batch, const std::vector<Pose2>& T_map_body);
/// Share of the held-out returns that lie on walls of any other scan, one of the same traversal, too: about 1
/// in a building, 0 where nothing is straight. Needs no second visit. One pose per scan. Allocates.
[[nodiscard]] double share_on_walls_of_any(const BatchRefinement& batch,
                                           const std::vector<Pose2>& T_map_body);
/// Then walls and poses together, by refine_jointly(), from what refine_in_turn() reports and returns.
/// Accepted where that was, else on the same condition: in turn, scans move to the returns that share their
/// poses with those held out. Where it is not, and where there is no solution (kSolver), both are left as
/// they are.
Status refine_together(const BatchRefinement& batch, RefinementReport& report,
                       std::vector<Pose2>& T_map_body);
/// The same with the floors as unknowns, by refine_jointly_with_floor(). Where it was not accepted, the
/// findings cost nothing.
Result<FloorFindings> refine_together_with_floor(const BatchRefinement& batch, RefinementReport& report,
                                                 std::vector<Pose2>& T_map_body);

}  // namespace swiftlet
