// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "core/backend/refinement/batch_problem.hpp"

#include "core/backend/store/traversal.hpp"
#include "core/sensing/systematic_motion.hpp"

namespace swiftlet {
namespace {

RefinementProblem hits_of(const BatchRefinement& batch) {
  const RefinementTuning& tuning = batch.config.tuning.refinement;
  RefinementProblem hits(tuning);
  const ScanRange range = batch.scan_range();
  const std::size_t first = batch.scans.all().position(range.first);
  const std::size_t every = thinned_by(batch.scans.return_count(range), batch.max_returns, tuning);
  const std::span<const StoredScan> stored = batch.stored();
  for (std::size_t i = 0; i < stored.size(); ++i) {
    const ScanId id = batch.scans.all().id_at(first + i);
    for (const ScanReturn& beam : batch.scans.returns(stored[i])) {
      if (!beam.is_hit || (i + beam.beam) % every != 0) continue;
      hits.add({make_id<PoseIndex>(i), index_of(traversal_of(stored[i])), stored[i].storey,
                is_held_out(id, beam.beam, tuning), batch.scans.point_body(beam)});
    }
  }
  return hits;
}

/// Dead reckoning from each scan to the next.
std::vector<BatchProblem::Factor> motions_of(const BatchRefinement& batch) {
  const SensorModel& sensor = batch.sensor;
  const std::span<const StoredScan> scans = batch.stored();
  std::vector<BatchProblem::Factor> motions;
  for (std::size_t i = 1; i < scans.size(); ++i) {
    BatchProblem::Factor c;
    c.from = make_id<PoseIndex>(i - 1);
    c.to = make_id<PoseIndex>(i);
    if (batch.dead_reckoning == DeadReckoning::kAsReported)
      c.T_from_to = reported_motion(scans[i - 1], scans[i], sensor.calibration_as_reported());
    else if (!scans[i].starts_segment || scans[i].odometry_ran_on)
      c.T_from_to = between(scans[i - 1].T_dead_body, scans[i].T_dead_body);
    if (i < batch.step_scale.size()) c.T_from_to = stretched(c.T_from_to, batch.step_scale[i]);
    c.information =
        motion_information(scans[i - 1], scans[i], sensor.odometry) / sensor.odometry.steps_err_together;
    motions.push_back(c);
  }
  weaken_doubted(batch.doubted, batch.scans, batch.scan_range(), motions);
  return motions;
}

}  // namespace

BatchProblem::BatchProblem(const BatchRefinement& batch)
    : poses_(batch.stored().size()), hits_(hits_of(batch)), factors_(motions_of(batch)) {
  const std::size_t first = batch.scans.all().position(batch.scan_range().first);
  const auto pose_of = [&](ScanId scan) {
    return make_id<PoseIndex>(batch.scans.all().position(scan) - first);
  };
  for (const RelativePoseFactor<ScanId>& c : batch.closures)
    factors_.push_back(c.joining(pose_of(c.from), pose_of(c.to)));
  for (const HeadingFactor<ScanId>& f : batch.headings) headings_.push_back(f.of(pose_of(f.pose)));
}

Status BatchProblem::take_round(double radius_m, std::vector<Pose2>& T_map_body) {
  if (!is_prepared_)
    if (Status status = system_.prepare(poses_, factors_); !status) return status;
  is_prepared_ = true;
  system_.set_zero();
  for (const Factor& f : factors_) system_.add(f, 1.0, T_map_body);
  for (const Heading& f : headings_) system_.add(f, 1.0, T_map_body);
  hits_.add_factors(hits_.walls_at(T_map_body, radius_m), T_map_body, system_);
  const Result<double> largest = system_.step(T_map_body);
  return largest ? Status() : Status(largest.error());
}

}  // namespace swiftlet
