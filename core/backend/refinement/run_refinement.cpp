// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "core/backend/refinement/run_refinement.hpp"

#include <span>
#include <utility>
#include <vector>

#include "core/backend/refinement/batch_refinement.hpp"
#include "core/geometry/angle.hpp"

namespace swiftlet {
namespace {

/// As DCS weighted it last.
template <typename Factor>
void scale_information(Factor& factor) {
  factor.information *= factor.dcs_scale * factor.dcs_scale;
}

std::vector<RelativePoseFactor<ScanId>> closures_between_scans(const PoseGraph& graph,
                                                               const KeyframeChain& chain) {
  std::vector<RelativePoseFactor<ScanId>> closures;
  for (const RelativePoseFactor<KeyframeId>& f : graph.factors.values()) {
    if (!f.is_closure || f.information.isZero(0.0)) continue;
    closures.push_back(f.joining(chain.scan_of(f.from), chain.scan_of(f.to)));
    scale_information(closures.back());
  }
  return closures;
}

std::vector<HeadingFactor<ScanId>> headings_of_scans(const PoseGraph& graph, const KeyframeChain& chain) {
  std::vector<HeadingFactor<ScanId>> headings;
  for (const HeadingFactor<KeyframeId>& f : graph.headings) {
    headings.push_back(f.of(chain.scan_of(f.pose)));
    scale_information(headings.back());
  }
  return headings;
}

}  // namespace

RunRefinement::RunRefinement(const BackendConfig& config, const SensorModel& sensor, const ScanStore& scans,
                             const KeyframeChain& chain)
    : config_(&config),
      sensor_(sensor),
      scans_(&scans),
      chain_(&chain),
      online_(scans, chain, sensor, config.tuning) {}

void RunRefinement::follow(const KeyframePoses& T_map_keyframe) {
  if (is_wanted()) online_.follow(T_map_keyframe);
}

ScanRange RunRefinement::refine_window(const KeyframePoses& T_map_keyframe,
                                       const KeyframePoses& T_local_keyframe) {
  if (!is_wanted()) return {};
  const Result<ScanRange> refined = online_.step(T_map_keyframe, T_local_keyframe);
  if (refined) return *refined;
  ++counters_.solver_failures;
  return {};
}

bool RunRefinement::refine_all(const PoseGraph& graph) {
  if (!is_wanted() || scans_->size() < 2) return false;
  const ScanRange all{scans_->all().first_id(), scans_->all().end_id()};
  std::vector<Pose2> T_map_body = chain_->T_w_bodies(all, graph.T_map_keyframe);
  const Result<RefinementReport> report =
      refine_scan_poses(*scans_, sensor_, closures_between_scans(graph, *chain_),
                        headings_of_scans(graph, *chain_), *config_, T_map_body, config_->tuning.refinement);
  if (!report) {
    ++counters_.solver_failures;
    return false;
  }
  counters_.held_out_before_m = report->held_out_before_m;
  counters_.held_out_after_m = report->held_out_after_m;
  counters_.refined = report->accepted;
  if (report->accepted) T_map_refined_ = scans_->all().with(std::move(T_map_body));
  return report->accepted;
}

void RunRefinement::erase(const IdRanges<ScanId>& scans, const IdRanges<TraversalId>& traversals) {
  online_.erase(scans, traversals);
}

Pose2 RunRefinement::T_map_body(ScanId scan, const KeyframePoses& T_map_keyframe) const {
  if (is_final()) return T_map_refined_[scan];
  return online_.refined(scan, chain_->T_w_body(scan, T_map_keyframe));
}

Pose2 RunRefinement::T_map_newest(const KeyframePoses& T_map_keyframe,
                                  const KeyframePoses& T_local_keyframe) const {
  const std::span<const ScanId> scans = chain_->all().values();
  const Pose2 T_map_tip = T_map_body(scans.back(), T_map_keyframe);
  if (!is_wanted() || is_final()) return T_map_tip;
  const std::span<const Pose2> T_local = T_local_keyframe.values();
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();  // of differences from the tip
  std::size_t count = 0;
  const std::size_t most = config_->tuning.online.keyframes_of_correction;
  for (std::size_t k = scans.size(); k-- > 0 && count < most;) {
    const Pose2 T_map_seen = T_map_body(scans[k], T_map_keyframe) * between(T_local[k], T_local.back());
    sum += Eigen::Vector3d(T_map_seen.x_m() - T_map_tip.x_m(), T_map_seen.y_m() - T_map_tip.y_m(),
                           wrap_angle(T_map_seen.yaw_rad() - T_map_tip.yaw_rad()));
    ++count;
    if ((*scans_)[scans[k]].starts_segment) break;
  }
  const Eigen::Vector3d mean = sum / static_cast<double>(count);
  return {T_map_tip.x_m() + mean(0), T_map_tip.y_m() + mean(1), T_map_tip.yaw_rad() + mean(2)};
}

RefinementCounters RunRefinement::counters() const {
  RefinementCounters counters = counters_;
  counters.windows_refined = online_.windows_refined();
  counters.windows_refused = online_.windows_refused();
  return counters;
}

}  // namespace swiftlet
