// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "core/backend/refinement/stretch_refinement.hpp"

#include <utility>

#include "core/backend/refinement/joint_refinement.hpp"
#include "core/geometry/rigid_alignment.hpp"

namespace swiftlet {

namespace {

std::vector<Point2> positions(std::span<const Pose2> poses) {
  std::vector<Point2> points;
  points.reserve(poses.size());
  for (const Pose2& T : poses) points.push_back(T.position());
  return points;
}

}  // namespace

StretchRefinement::Job::Job(const BatchRefinement& what, std::vector<Pose2> T_map_begun,
                            std::vector<Pose2> T_map_start)
    : batch(what), problem(what), T_map_graph(std::move(T_map_begun)), T_map_body(std::move(T_map_start)) {
  batch.closures = {};
  batch.headings = {};
  batch.doubted = {};
}

void StretchRefinement::begin(const BatchRefinement& batch, std::vector<Pose2> T_map_graph,
                              const Pose2& T_graph_refined) {
  SWIFTLET_CHECK(T_map_graph.size() == batch.stored().size() && T_map_graph.size() > 1,
                 "two scans or more, each with a pose");
  const Pose2 T_map_moved = T_map_graph.front() * T_graph_refined * T_map_graph.front().inverse();
  std::vector<Pose2> T_map_body;
  T_map_body.reserve(T_map_graph.size());
  for (const Pose2& T : T_map_graph) T_map_body.push_back(T_map_moved * T);
  job_ = std::make_unique<Job>(batch, std::move(T_map_graph), std::move(T_map_body));
}

Status StretchRefinement::step() {
  if (!job_ || job_->is_solved) return {};
  Status status = job_->step();
  if (!status) abandon();
  return status;
}

Status StretchRefinement::Job::step() {
  const BackendTuning& tuning = batch.config.tuning;
  if (rounds < tuning.refinement.wide_iterations) {
    ++rounds;
    return problem.take_round(tuning.refinement.wide_radius_m, T_map_body);
  }
  if (!together) {
    together = joint_problem(batch.stored(), batch.sensor, problem.hits().returns(), problem.headings(),
                             tuning, problem.factors(), T_map_body);
    together->associate();
    return {};
  }
  if (Status status = together->step(); !status) return status;
  if (++steps < tuning.joint.steps_per_association) return {};
  T_map_body = path_of(*together, T_map_body.front());
  if (batch.scan_range().first != batch.scans.all().first_id()) lay_onto_graph();
  is_solved = true;
  return {};
}

/// Its first scan alone holds a stretch in the middle of a run, and an error of that one's heading would move
/// its end by metres. Where it lies as a whole the graph knows better.
void StretchRefinement::Job::lay_onto_graph() {
  const Pose2 T_graph_body = rigid_alignment(positions(T_map_body), positions(T_map_graph));
  for (Pose2& T : T_map_body) T = T_graph_body * T;
}

double StretchRefinement::Job::held_out_m(const std::vector<Pose2>& T_map) const {
  const double radius_m = batch.config.tuning.refinement.walls.radius_m;
  return problem.hits().held_out_error_m(problem.hits().walls_at(T_map, radius_m), T_map);
}

std::optional<StretchRefinement::Found> StretchRefinement::finish() {
  SWIFTLET_CHECK(is_solved(), "no slice is left");
  const std::unique_ptr<Job> job = std::move(job_);
  HeldOutVerdict verdict;
  verdict.judge(job->held_out_m(job->T_map_graph), job->held_out_m(job->T_map_body));
  if (!verdict.accepted) return std::nullopt;
  Found found{job->batch.scan_range(), {}};
  for (std::size_t i = 0; i < job->T_map_body.size(); ++i)
    found.T_graph_refined.push_back(between(job->T_map_graph[i], job->T_map_body[i]));
  return found;
}

}  // namespace swiftlet
