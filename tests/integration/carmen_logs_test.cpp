// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
//
// Laser logs thinned to 11 beams, judged by the true motions that were measured between their scans.

#include <gtest/gtest.h>

#include <ostream>
#include <string>
#include <utility>
#include <vector>

#include "core/evaluation/relation_error.hpp"
#include "tests/support/corrected_run.hpp"
#include "tests/support/reference_data.hpp"
#include "tools/evaluation/relations_file.hpp"

namespace swiftlet {
namespace {

struct KnownLog {
  const char* name;
  std::size_t relations;
  double mean_m;    ///< at most; the paper's own code: 0.0454 m and 1.131 degrees (ACES), ...
  double mean_deg;  ///< ... 0.0901 m and 2.363 degrees (Intel)
};
void PrintTo(const KnownLog& known, std::ostream* out) { *out << known.name; }

StampedPath stamped(const CorrectedRun& run, const std::vector<Pose2>& T_map_body) {
  std::vector<StampedPose> poses;
  for (std::size_t i = 0; i < T_map_body.size(); ++i) poses.push_back({run.samples[i].stamp, T_map_body[i]});
  return StampedPath(std::move(poses));
}

class LaserLog : public testing::TestWithParam<KnownLog> {};

TEST_P(LaserLog, IsCorrectedBeyondThePapersResults) {
  const std::string log = reference_file("radish/" + std::string(GetParam().name) + ".clf.gz");
  const std::string truth = reference_file("radish/" + std::string(GetParam().name) + ".relations");
  SWIFTLET_REQUIRE_REFERENCE(log);
  SWIFTLET_REQUIRE_REFERENCE(truth);
  const CorrectedRun run = corrected_run(log);
  const Result<std::vector<Relation>> relations = read_relations_file(truth);
  ASSERT_TRUE(relations.ok()) << relations.error().message;
  ASSERT_EQ(relations->size(), GetParam().relations);

  const RelationError corrected = relation_error(*relations, stamped(run, run.T_map_body));
  EXPECT_EQ(corrected.missed, 0U);
  EXPECT_LE(corrected.all.translation_m.mean, GetParam().mean_m);
  EXPECT_LE(corrected.all.rotation_deg.mean, GetParam().mean_deg);
  const RelationError uncorrected = relation_error(*relations, stamped(run, dead_reckoned(run)));
  EXPECT_GT(uncorrected.all.translation_m.mean, 10.0 * GetParam().mean_m) << "there is something to correct";
  EXPECT_EQ(run.counters.solver_failures, 0U);
}

INSTANTIATE_TEST_SUITE_P(Radish, LaserLog,
                         testing::Values(KnownLog{"aces", 1279, 0.036, 0.47},
                                         KnownLog{"intel", 2984, 0.0312, 0.84}),
                         [](const auto& log) { return std::string(log.param.name); });

}  // namespace
}  // namespace swiftlet
