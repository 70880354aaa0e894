// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "core/backend/pose_graph/building_axis_prior.hpp"

#include <algorithm>
#include <cmath>

#include "core/geometry/angle.hpp"

namespace swiftlet {
namespace {

double yaw_map_rad(const PoseGraph& graph, KeyframeId keyframe) {
  return graph.T_map_keyframe[keyframe].yaw_rad();
}

/// Whether the heading is off by this much, and not the other way round.
bool is_unambiguous(double off_rad, double variance_rad2, const BuildingAxisPriorTuning& tuning) {
  const double other_rad = kPi / 2.0 - std::abs(off_rad);
  return off_rad * off_rad <= tuning.gate_sigmas * tuning.gate_sigmas * variance_rad2 &&
         other_rad * other_rad - off_rad * off_rad >= 2.0 * tuning.min_log_odds * variance_rad2;
}

}  // namespace

/// Circular mean over a quarter turn, weighted by the information that DCS leaves of each heading.
double BuildingAxisPrior::building_axis_rad(const PoseGraph& graph) const {
  double x = 0.0;
  double y = 0.0;
  for (std::size_t i = 0; i < axes_.size(); ++i) {
    const HeadingFactor<KeyframeId>& heading = graph.headings[i];
    const double yaw_rad = 4.0 * (yaw_map_rad(graph, heading.pose) + axes_[i].yaw_rad);
    const double weight = heading.dcs_scale * heading.dcs_scale * heading.information;
    x += weight * std::cos(yaw_rad);
    y += weight * std::sin(yaw_rad);
  }
  return std::atan2(y, x) / 4.0;
}

void BuildingAxisPrior::add(KeyframeId keyframe, const WallAxis& axis, double yaw_variance_rad2,
                            PoseGraph& graph) {
  if (!axes_.empty()) {
    const double off_rad = wrap_axis(yaw_map_rad(graph, keyframe) + axis.yaw_rad - building_axis_rad(graph));
    if (!is_unambiguous(off_rad, yaw_variance_rad2 + axis.sigma_rad * axis.sigma_rad, tuning_)) return;
  }
  axes_.push_back(axis);
  const double variance_rad2 = tuning_.variance_factor * axis.sigma_rad * axis.sigma_rad;
  graph.headings.push_back({.pose = keyframe, .information = 1.0 / variance_rad2});
}

void BuildingAxisPrior::erase(const IdRanges<KeyframeId>& pruned, PoseGraph& graph) {
  std::size_t kept = 0;
  for (std::size_t i = 0; i < axes_.size(); ++i) {
    if (pruned.contains(graph.headings[i].pose)) continue;
    graph.headings[kept] = graph.headings[i];
    axes_[kept++] = axes_[i];
  }
  graph.headings.resize(kept);
  axes_.resize(kept);
}

void BuildingAxisPrior::update(PoseGraph& graph) const {
  const double building_rad = building_axis_rad(graph);
  for (std::size_t i = 0; i < axes_.size(); ++i) {
    HeadingFactor<KeyframeId>& heading = graph.headings[i];
    const double now_rad = yaw_map_rad(graph, heading.pose);
    heading.yaw_map_rad = now_rad - wrap_axis(now_rad + axes_[i].yaw_rad - building_rad);
  }
}

}  // namespace swiftlet
