// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "core/calibration/stretch_estimate.hpp"

#include <algorithm>
#include <vector>

#include "core/frontend/frontend.hpp"

namespace swiftlet {
namespace {

constexpr double kApartM = 1e4;  // the stretches have no wall in common

/// The stretches, one after the other.
struct MappedStretches {
  std::vector<CalibrationScan> scans;
  std::vector<Pose2> T_map_body;
};

/// Every so many-th hit, from scan to scan another one first.
void thin(std::size_t max_hits, std::size_t turn, std::vector<Point2>& hits) {
  if (hits.size() <= max_hits) return;
  const std::size_t every = (hits.size() + max_hits - 1) / max_hits;
  std::size_t kept = 0;
  for (std::size_t i = turn % every; i < hits.size(); i += every) hits[kept++] = hits[i];
  hits.resize(kept);
}

void add_stretch(std::span<const RangeSample> samples, const SensorModel& sensor, const BeamLayout& beams,
                 double apart_m, MappedStretches& stretches) {
  Frontend frontend(FrontendConfig{}, sensor, beams);
  const Pose2 T_map_stretch(apart_m, 0.0, 0.0);
  std::vector<CalibrationScan> scans = calibration_scans(samples, beams);
  scans.front().starts_segment = true;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    stretches.T_map_body.push_back(T_map_stretch * frontend.process(samples[i]).T_map_body);
    stretches.scans.push_back(std::move(scans[i]));
  }
}

MappedStretches map_stretches(std::span<const RangeSample> samples, const SensorModel& sensor,
                              const BeamLayout& beams, const StretchEstimateTuning& tuning) {
  MappedStretches stretches;
  const bool is_short = samples.size() <= tuning.scans;
  const std::size_t count = is_short ? 1 : std::max<std::size_t>(1, tuning.scans / tuning.stretch_scans);
  const std::size_t length = is_short ? samples.size() : std::min(tuning.stretch_scans, samples.size());
  for (std::size_t k = 0; k < count; ++k) {
    const std::size_t first = count == 1 ? 0 : k * (samples.size() - length) / (count - 1);
    add_stretch(samples.subspan(first, length), sensor, beams, static_cast<double>(k) * kApartM, stretches);
  }
  for (std::size_t i = 0; i < stretches.scans.size(); ++i)
    thin(tuning.hits_of_scan, i, stretches.scans[i].hits_body);
  return stretches;
}

}  // namespace

Result<JointEstimate> estimate_from_stretches(std::span<const RangeSample> samples, const SensorModel& sensor,
                                              const BeamLayout& beams, const StretchEstimateTuning& tuning) {
  const MappedStretches stretches = map_stretches(samples, sensor, beams, tuning);
  const GoOn always = [](double) { return true; };
  return estimate_jointly(stretches.scans, sensor, stretches.T_map_body, always, tuning.joint);
}

}  // namespace swiftlet
