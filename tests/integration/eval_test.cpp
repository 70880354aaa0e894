// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
//
// swiftlet eval from files to figures: by hand on small files, and on what others published.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <ostream>
#include <string>

#include "tests/firmware_link/synthetic_capture.hpp"
#include "tests/support/reference_data.hpp"
#include "tests/support/temporary_file.hpp"
#include "tools/eval_command.hpp"

namespace swiftlet {
namespace {

using nlohmann::json;

/// The figures against one reference.
json figures_of(const std::string& trajectory, const std::string& reference) {
  const TemporaryFile file("figures.json");
  EvalCommand command;
  command.trajectory = trajectory;
  command.references = {reference};
  command.json_file = file.path();
  const Status done = run_eval_command(command);
  EXPECT_TRUE(done.ok()) << done.error().message;
  return done ? json::parse(file.read())["references"].at(0) : json();
}

void expect_motions(const json& motions, int count, const std::array<double, 3>& translation_m,
                    const std::array<double, 3>& rotation_deg) {
  EXPECT_EQ(motions["count"], count);
  for (std::size_t i = 0; i < 3; ++i) {
    const char* name = std::array{"mean", "std", "max"}.at(i);
    EXPECT_NEAR(motions["translation_m"][name].get<double>(), translation_m.at(i), 1e-5) << name;
    EXPECT_NEAR(motions["rotation_deg"][name].get<double>(), rotation_deg.at(i), 1e-3) << name;
  }
}

TEST(Eval, AgreesWithRelationsComputedByHand) {
  const TemporaryFile trajectory("trajectory.tum",
                                 "200 10 0 0 0 0 0.707106781 0.707106781\n"
                                 "10 0 0 0 0 0 0 1\n"
                                 "11 1 0 0 0 0 0 1\n"
                                 "15 5 0 0 0 0 0.707106781 0.707106781\n");
  const TemporaryFile relations("true.txt",
                                "10 11         1.3  0.4 0 0 0  0\n"           // off by 0.5 m
                                "11 15         4.0  0.0 0 0 0  1.535890\n"    // by 2 degrees
                                "15 200        0.0 -5.1 0 0 0  0.052360\n"    // by 0.1 m and 3 degrees
                                "200.001 10.000005 0.2 10 0 0 0 -1.570796\n"  // by 0.2 m
                                "15 99         0.0  0.0 0 0 0  0\n");
  const json figures = figures_of(trajectory.path(), relations.path());
  EXPECT_EQ(figures["kind"], "relations");
  EXPECT_EQ(figures["missed"], 1);
  expect_motions(figures["all"], 4, {0.2, std::sqrt(0.035), 0.5}, {1.25, std::sqrt(1.6875), 3.0});
  expect_motions(figures["under_3_s"], 1, {0.5, 0.0, 0.5}, {0.0, 0.0, 0.0});
  expect_motions(figures["from_3_to_100_s"], 1, {0.0, 0.0, 0.0}, {2.0, 0.0, 2.0});
  expect_motions(figures["over_100_s"], 2, {0.15, 0.05, 0.2}, {1.5, 1.5, 3.0});
  ASSERT_EQ(figures["each_translation_m"].size(), 5U);
  EXPECT_NEAR(figures["each_translation_m"][3].get<double>(), 0.2, 1e-4);
  EXPECT_TRUE(figures["each_translation_m"][4].is_null());
  EXPECT_EQ(figures["stamps"]["exact"], 5);
  EXPECT_EQ(figures["stamps"]["within_2_ms"], 1);
  EXPECT_EQ(figures["stamps"]["unmatched_s"], json({99.0}));
}

TEST(Eval, AgreesWithPositionsComputedByHand) {
  // A cross whose one bar is stretched; turned by a quarter and moved.
  const TemporaryFile truth("truth.tum",
                            "1 1 0 0 0 0 0 1\n2 0 2 0 0 0 0 1\n3 -1 0 0 0 0 0 1\n4 0 -2 0 0 0 0 1\n");
  const TemporaryFile trajectory("trajectory.tum",
                                 "1 5.0 6.5 0 0 0 0 1\n2 3.0 5.0 0 0 0 0 1\n2.5 9 9 0 0 0 0 1\n"
                                 "3.001 5.0 3.5 0 0 0 0 1\n4 7.0 5.0 0 0 0 0 1\n");
  const json figures = figures_of(trajectory.path(), truth.path());
  EXPECT_EQ(figures["kind"], "truth");
  EXPECT_EQ(figures["pairs"], 4);
  EXPECT_NEAR(figures["rmse_m"].get<double>(), std::sqrt(0.125), 1e-9);
  EXPECT_NEAR(figures["mean_m"].get<double>(), 0.25, 1e-9);
  EXPECT_NEAR(figures["max_m"].get<double>(), 0.5, 1e-9);
  EXPECT_NEAR(figures["T_truth_estimate"]["yaw_deg"].get<double>(), -90.0, 1e-9);
  EXPECT_EQ(figures["stamps"]["exact"], 3);
  EXPECT_EQ(figures["stamps"]["within_2_ms"], 1);
  EXPECT_EQ(figures["stamps"]["unmatched_s"], json({2.5}));
}

TEST(Eval, AgreesWithCellsCountedByHand) {
  const TemporaryFile capture("flight.pcap");
  write_capture(capture.path(), SyntheticCapture().frames());
  // The samples at 1.1 to 1.7 s see a wall ahead that ends up at x = 2.03, and one 0.7 m to the left, at
  // x = 0.18, 0.23 and 0.28 from the poses in the trajectory's time. It has none for the second of these.
  const TemporaryFile trajectory("trajectory.tum",
                                 "1700000001.300000 0.18 0.01 0 0 0 0 1\n"
                                 "1700000001.500000 0.28 0.01 0 0 0 0 1\n");
  const json figures = figures_of(trajectory.path(), capture.path());
  EXPECT_EQ(figures["kind"], "flight");
  EXPECT_EQ(figures["drawn"], 3);
  EXPECT_EQ(figures["interpolated"], 1);
  EXPECT_EQ(figures["outside_s"], json({1700000001.1, 1700000001.2, 1700000001.6, 1700000001.7}));
  EXPECT_EQ(figures["unpaired"], 1);
  EXPECT_EQ(figures["returns"], 6);
  EXPECT_EQ(figures["cells_10_cm"], 3);
  EXPECT_EQ(figures["cells_20_cm"], 3);
}

/// Of the paper's own code, as computed independently from the same files.
struct PublishedPath {
  const char* trajectory;
  const char* relations;
  int count;
  int missed;
  std::array<double, 3> translation_m;  ///< mean, standard deviation, maximum
  std::array<double, 2> rotation_deg;   ///< mean, standard deviation
  std::array<int, 3> counts;            ///< under 3 s, 3 to 100 s, over 100 s
  std::array<double, 3> split_m;        ///< means
  std::array<double, 3> split_deg;
};
void PrintTo(const PublishedPath& path, std::ostream* out) { *out << path.trajectory; }

class PublishedLaserPath : public testing::TestWithParam<PublishedPath> {};

TEST_P(PublishedLaserPath, HasTheKnownErrors) {
  const PublishedPath& known = GetParam();
  const std::string trajectory = reference_file("paper_results/" + std::string(known.trajectory) + ".tum");
  const std::string relations = reference_file("radish/" + std::string(known.relations) + ".relations");
  SWIFTLET_REQUIRE_REFERENCE(trajectory);
  SWIFTLET_REQUIRE_REFERENCE(relations);
  const json figures = figures_of(trajectory, relations);
  EXPECT_EQ(figures["missed"], known.missed);
  const json& all = figures["all"];
  EXPECT_EQ(all["count"], known.count);
  EXPECT_NEAR(all["translation_m"]["mean"].get<double>(), known.translation_m[0], 5.1e-5);
  EXPECT_NEAR(all["translation_m"]["std"].get<double>(), known.translation_m[1], 5.1e-5);
  EXPECT_NEAR(all["translation_m"]["max"].get<double>(), known.translation_m[2], 5.1e-3);
  EXPECT_NEAR(all["rotation_deg"]["mean"].get<double>(), known.rotation_deg[0], 5.1e-4);
  EXPECT_NEAR(all["rotation_deg"]["std"].get<double>(), known.rotation_deg[1], 5.1e-4);
  for (std::size_t i = 0; i < 3; ++i) {
    const json& part = figures[std::array{"under_3_s", "from_3_to_100_s", "over_100_s"}.at(i)];
    EXPECT_EQ(part["count"], known.counts.at(i));
    EXPECT_NEAR(part["translation_m"]["mean"].get<double>(), known.split_m.at(i), 5.1e-5);
    EXPECT_NEAR(part["rotation_deg"]["mean"].get<double>(), known.split_deg.at(i), 5.1e-4);
  }
}

INSTANTIATE_TEST_SUITE_P(Radish, PublishedLaserPath,
                         testing::Values(PublishedPath{.trajectory = "intel_11",
                                                       .relations = "intel",
                                                       .count = 2883,
                                                       .missed = 101,
                                                       .translation_m = {0.0901, 0.1268, 1.06},
                                                       .rotation_deg = {2.350, 2.513},
                                                       .counts = {1628, 83, 1172},
                                                       .split_m = {0.0269, 0.0842, 0.1783},
                                                       .split_deg = {1.687, 3.026, 3.222}},
                                         PublishedPath{.trajectory = "aces_4",
                                                       .relations = "aces",
                                                       .count = 1223,
                                                       .missed = 56,
                                                       .translation_m = {0.0445, 0.0484, 0.36},
                                                       .rotation_deg = {1.006, 1.273},
                                                       .counts = {1131, 11, 81},
                                                       .split_m = {0.0383, 0.0772, 0.1256},
                                                       .split_deg = {0.916, 1.915, 2.135}}),
                         [](const auto& path) { return std::string(path.param.trajectory); });

struct PublishedFlight {
  const char* name;
  int returns;
  int cells_10_cm;
  int cells_20_cm;
};
void PrintTo(const PublishedFlight& flight, std::ostream* out) { *out << flight.name; }

class PublishedFlightPath : public testing::TestWithParam<PublishedFlight> {};

TEST_P(PublishedFlightPath, HitsTheKnownCells) {
  const PublishedFlight& known = GetParam();
  const std::string trajectory = reference_file("paper_results/" + std::string(known.name) + ".tum");
  const std::string capture = reference_file("flights/" + std::string(known.name) + ".pcap");
  SWIFTLET_REQUIRE_REFERENCE(trajectory);
  SWIFTLET_REQUIRE_REFERENCE(capture);
  const json figures = figures_of(trajectory, capture);
  // Known of the readings as logged: levelled, some more are nearer than 2 m, and some cells change.
  constexpr double kLevelled = 0.003;
  EXPECT_NEAR(figures["returns"], known.returns, kLevelled * known.returns);
  EXPECT_NEAR(figures["cells_10_cm"], known.cells_10_cm, kLevelled * known.cells_10_cm);
  EXPECT_NEAR(figures["cells_20_cm"], known.cells_20_cm, kLevelled * known.cells_20_cm);
}

INSTANTIATE_TEST_SUITE_P(Recorded, PublishedFlightPath,
                         testing::Values(PublishedFlight{"olsson", 8914, 5298, 2599},
                                         PublishedFlight{"rice", 6304, 3675, 2025}),
                         [](const auto& flight) { return std::string(flight.param.name); });

}  // namespace
}  // namespace swiftlet
