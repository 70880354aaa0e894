// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "tests/support/corrected_run.hpp"

#include <gtest/gtest.h>

#include "core/evaluation/trajectory_error.hpp"
#include "core/frontend/frontend.hpp"
#include "firmware_link/input/open_sample_source.hpp"

namespace swiftlet {

CorrectedRun corrected_run(SampleSource& source) {
  CorrectedRun run;
  Frontend frontend({}, source.sensor(), source.beams());
  Backend backend({}, source.sensor(), source.beams());
  Result<ReceivedSample> received = source.next();
  for (; received || received.error().code == ErrorCode::kTimeout; received = source.next()) {
    if (!received) continue;
    run.samples.push_back(received->sample);
    backend.add(frontend.process(received->sample));
    run.tracking.push_back(backend.tracking().tracking);
  }
  EXPECT_EQ(received.error().code, ErrorCode::kEndOfRecording) << received.error().message;
  source.end();
  backend.finish();
  for (const auto& [id, scan] : backend.scans().all()) run.T_map_body.push_back(backend.T_map_body(id));
  run.counters = backend.counters();
  run.truth = source.ground_truth();
  run.input = source.report();
  return run;
}

CorrectedRun corrected_run(const std::string& uri) {
  const auto source = open_sample_source(uri, {});
  EXPECT_TRUE(source.ok()) << (source.ok() ? "" : source.error().message);
  return source ? corrected_run(**source) : CorrectedRun{};
}

double error_m(const CorrectedRun& run, const std::vector<Pose2>& poses) {
  std::vector<Point2> found_m;
  for (const Pose2& pose : poses) found_m.push_back(pose.position());
  std::vector<Point2> true_m;
  for (const StampedPose& at : run.truth) true_m.push_back(at.pose.position());
  return trajectory_error(found_m, true_m).rmse_m;
}

std::vector<Pose2> dead_reckoned(const CorrectedRun& run) {
  std::vector<Pose2> T_odom_body;
  for (const RangeSample& sample : run.samples) T_odom_body.push_back(sample.T_odom_body);
  return T_odom_body;
}

}  // namespace swiftlet
