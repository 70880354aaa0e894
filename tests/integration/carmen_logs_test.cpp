// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
//
// Laser logs thinned to 11 beams, judged by the true motions that were measured between their scans.

#include <gtest/gtest.h>

#include <fstream>
#include <ostream>
#include <string>
#include <vector>

#include "tests/support/corrected_run.hpp"
#include "tests/support/reference_data.hpp"
#include "tests/support/relation_error.hpp"

namespace swiftlet {
namespace {

struct KnownLog {
  const char* name;
  std::size_t relations;
  double mean_m;    ///< at most; the paper's own code: 0.0454 m and 1.131 degrees (ACES), ...
  double mean_deg;  ///< ... 0.0901 m and 2.363 degrees (Intel)
};
void PrintTo(const KnownLog& known, std::ostream* out) { *out << known.name; }

class LaserLog : public testing::TestWithParam<KnownLog> {};

TEST_P(LaserLog, IsCorrectedBeyondThePapersResults) {
  const std::string log = reference_file("radish/" + std::string(GetParam().name) + ".clf.gz");
  const std::string truth = reference_file("radish/" + std::string(GetParam().name) + ".relations");
  SWIFTLET_REQUIRE_REFERENCE(log);
  SWIFTLET_REQUIRE_REFERENCE(truth);
  const CorrectedRun run = corrected_run(log);
  std::vector<HostTime> stamps;
  for (const RangeSample& sample : run.samples) stamps.push_back(sample.stamp);
  std::ifstream lines(truth);
  const std::vector<Relation> relations = read_relations(lines);
  ASSERT_EQ(relations.size(), GetParam().relations);

  const RelationError corrected = relation_error(relations, stamps, run.T_map_body);
  EXPECT_EQ(corrected.missed, 0U);
  EXPECT_LE(corrected.mean_m, GetParam().mean_m);
  EXPECT_LE(corrected.mean_deg, GetParam().mean_deg);
  EXPECT_GT(relation_error(relations, stamps, dead_reckoned(run)).mean_m, 10.0 * GetParam().mean_m)
      << "there is something to correct";
  EXPECT_EQ(run.counters.solver_failures, 0U);
}

INSTANTIATE_TEST_SUITE_P(Radish, LaserLog,
                         testing::Values(KnownLog{"aces", 1279, 0.036, 0.46},
                                         KnownLog{"intel", 2984, 0.0312, 0.84}),
                         [](const auto& log) { return std::string(log.param.name); });

}  // namespace
}  // namespace swiftlet
