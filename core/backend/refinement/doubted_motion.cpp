// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "core/backend/refinement/doubted_motion.hpp"

#include <algorithm>

#include "core/geometry/squared.hpp"
#include "core/sensing/odometry_covariance.hpp"

namespace swiftlet {

std::vector<DoubtedMotion> doubted_motions(const PoseGraph& graph, const KeyframeChain& chain) {
  std::vector<DoubtedMotion> doubted;
  for (const FactorId id : graph.doubted) {
    const RelativePoseFactor<KeyframeId>& motion = graph.factors[id];
    const double weight = motion.information.isZero(0.0) ? 0.0 : squared(motion.dcs_scale);
    doubted.push_back({{chain.scan_of(motion.from) + 1, chain.scan_of(motion.to) + 1}, weight});
  }
  return doubted;
}

void weaken_doubted(std::span<const DoubtedMotion> doubted, const ScanStore& scans, const ScanRange& range,
                    std::span<RelativePoseFactor<PoseIndex>> steps) {
  const std::size_t first = scans.all().position(range.first);
  for (const DoubtedMotion& motion : doubted) {
    const ScanRange to{std::max(motion.scans.first, range.first + 1), std::min(motion.scans.end, range.end)};
    if (to.empty()) continue;
    for (RelativePoseFactor<PoseIndex>& step :
         steps.subspan(scans.all().position(to.first) - first - 1, scans.all().count(to))) {
      step.information *= motion.weight;
      step.information.diagonal() += kUnknownMotion.information();
    }
  }
}

}  // namespace swiftlet
