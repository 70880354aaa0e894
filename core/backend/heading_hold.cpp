// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "core/backend/heading_hold.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/geometry/angle.hpp"

namespace swiftlet {
namespace {

constexpr double kSigmas = 3.0;
constexpr double kWidestRad = radians(30);  // nearer to the middle between two axes nothing can be told
constexpr double kClearChiSquare = 6.0;     // by which the nearest axis must be nearer than the next
// An axis is what the first votes say of it, and stays: were it the mean of all, it would follow the drift.
constexpr std::size_t kDefiningVotes = 12;
constexpr std::size_t kVotesForAnAxis = 3;  // in a row, that belong to no other
constexpr double kSharedWalls =
    3.0;  // votes a few metres apart are cast by the same walls: they err together

double squared(double x) { return x * x; }

double yaw_map_rad(const PoseGraph& graph, KeyframeId keyframe) {
  return graph.T_map_keyframe[index_of(keyframe)].yaw_rad();
}

}  // namespace

struct HeadingHold::Candidate {
  std::size_t axis = 0;
  double off_rad = std::numeric_limits<double>::infinity();
  double next_off_rad = std::numeric_limits<double>::infinity();  ///< of the axis next to it
};

/// Mean on a quarter turn's circle, weighted by how far each vote is believed.
double HeadingHold::axis_map_rad(std::size_t axis, const PoseGraph& graph) const {
  double x = 0.0;
  double y = 0.0;
  for (const std::size_t i : first_votes_[axis]) {
    const HeadingConstraint& heading = graph.headings[i];
    const double yaw_rad = 4.0 * (yaw_map_rad(graph, heading.keyframe) + votes_[i].axis.yaw_rad);
    const double weight = squared(heading.dcs_scale) * heading.information;
    x += weight * std::cos(yaw_rad);
    y += weight * std::sin(yaw_rad);
  }
  return std::atan2(y, x) / 4.0;
}

HeadingHold::Candidate HeadingHold::nearest_axis(const Vote& vote, const PoseGraph& graph) const {
  Candidate nearest;
  for (std::size_t axis = 0; axis < first_votes_.size(); ++axis) {
    const double off_rad = std::abs(
        wrap_axis(yaw_map_rad(graph, vote.keyframe) + vote.axis.yaw_rad - axis_map_rad(axis, graph)));
    if (off_rad < nearest.off_rad) {
      nearest = {axis, off_rad, nearest.off_rad};
    } else {
      nearest.next_off_rad = std::min(nearest.next_off_rad, off_rad);
    }
  }
  return nearest;
}

void HeadingHold::take(const Vote& vote, std::size_t axis, PoseGraph& graph) {
  if (first_votes_[axis].size() < kDefiningVotes) first_votes_[axis].push_back(votes_.size());
  votes_.push_back(vote);
  axis_of_.push_back(axis);
  graph.headings.push_back(
      {.keyframe = vote.keyframe, .information = 1.0 / (kSharedWalls * squared(vote.axis.sigma_rad))});
}

/// Votes for no known axis become one when they agree for long enough.
void HeadingHold::wait(const Vote& vote, PoseGraph& graph) {
  if (!waiting_.empty()) {
    const Vote& last = waiting_.back();
    const double off_rad = wrap_axis(yaw_map_rad(graph, vote.keyframe) + vote.axis.yaw_rad -
                                     yaw_map_rad(graph, last.keyframe) - last.axis.yaw_rad);
    if (std::abs(off_rad) > kSigmas * std::hypot(vote.axis.sigma_rad, last.axis.sigma_rad)) waiting_.clear();
  }
  waiting_.push_back(vote);
  if (waiting_.size() < kVotesForAnAxis) return;
  first_votes_.emplace_back();
  for (const Vote& waiting : waiting_) take(waiting, first_votes_.size() - 1, graph);
  waiting_.clear();
}

void HeadingHold::add(KeyframeId keyframe, const WallAxis& axis, double yaw_variance_rad2, PoseGraph& graph) {
  const Vote vote{keyframe, axis};
  const Candidate nearest = nearest_axis(vote, graph);
  const double variance_rad2 = yaw_variance_rad2 + squared(axis.sigma_rad);
  if (nearest.off_rad > std::min(kWidestRad, kSigmas * std::sqrt(variance_rad2))) return wait(vote, graph);
  waiting_.clear();
  if (squared(nearest.next_off_rad) - squared(nearest.off_rad) < kClearChiSquare * variance_rad2) return;
  take(vote, nearest.axis, graph);
}

void HeadingHold::update(PoseGraph& graph) const {
  std::vector<double> axes_rad;
  for (std::size_t axis = 0; axis < first_votes_.size(); ++axis)
    axes_rad.push_back(axis_map_rad(axis, graph));
  for (std::size_t i = 0; i < votes_.size(); ++i) {
    HeadingConstraint& heading = graph.headings[i];
    const double now_rad = yaw_map_rad(graph, heading.keyframe);
    heading.yaw_map_rad = now_rad - wrap_axis(now_rad + votes_[i].axis.yaw_rad - axes_rad[axis_of_[i]]);
  }
}

}  // namespace swiftlet
