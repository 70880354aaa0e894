// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "tools/evaluation/eval_report.hpp"

#include <gmock/gmock.h>

#include <chrono>
#include <nlohmann/json.hpp>
#include <optional>

namespace swiftlet {
namespace {

using nlohmann::json;
using std::chrono::microseconds;
using testing::HasSubstr;

HostTime at_us(std::int64_t us) { return HostTime(microseconds(us)); }

Evaluation evaluation_of(ReferenceResult result) {
  return {.trajectory_file = "trajectory.tum",
          .poses = 3816,
          .first_stamp = at_us(1'627'252'323'712'197),
          .last_stamp = at_us(1'627'252'704'955'267),
          .references = {std::move(result)}};
}

Evaluation of_relations() {
  RelationError error;
  error.all = {4, {0.2, 0.18708, 0.5}, {1.25, 1.299, 3.0}};
  error.under_3_s = {4, {0.2, 0.18708, 0.5}, {1.25, 1.299, 3.0}};
  error.missed = 2;
  error.each_translation_m = {0.5, std::nullopt, 0.25, 0.0, std::nullopt, 0.05};
  error.stamps = {
      6, 1, {at_us(1'000'000), at_us(2'500'000), at_us(3'000'000), at_us(1'629'657'168'376'475), at_us(5)}};
  return evaluation_of({"intel.relations", error});
}

Evaluation of_truth() {
  PathError error;
  error.position = {.pairs = 10,
                    .rmse_m = 0.3,
                    .mean_m = 0.25,
                    .max_m = 0.5,
                    .T_truth_estimate = Pose2(1.0, 2.0, radians(90.0))};
  error.stamps = {10, 0, {at_us(7'000'000)}};
  return evaluation_of({"truth.tum", error});
}

Evaluation of_flight() {
  FlightResult flight;
  flight.sharpness = {.map = {.returns = 9001, .cells_10_cm = 3436, .cells_20_cm = 1760},
                      .drawn = 3000,
                      .interpolated = 12,
                      .outside = {at_us(8'000'000)}};
  flight.input.counters.unpaired = 2;
  flight.input.problems = {"damaged"};
  return evaluation_of({"flight.pcap", flight});
}

TEST(EvaluationText, SplitsRelationsByTheTimeTheySpan) {
  EXPECT_EQ(evaluation_text(of_relations()),
            "trajectory.tum: 3816 poses over 381.2 s\n"
            "\n"
            "intel.relations: 4 of 6 relations\n"
            "                                     translation, m                 rotation, deg\n"
            "  time spanned  count        mean      std      max        mean      std      max\n"
            "  all               4      0.2000   0.1871   0.5000       1.250    1.299    3.000\n"
            "  under 3 s         4      0.2000   0.1871   0.5000       1.250    1.299    3.000\n"
            "  3 to 100 s        0\n"
            "  over 100 s        0\n"
            "  stamps: 6 exact, 1 within 2 ms, 5 unmatched\n"
            "  not in the trajectory: 1.000000 2.500000 3.000000 and 2 more\n");
}

TEST(EvaluationText, TellsTheErrorOfPositions) {
  EXPECT_THAT(evaluation_text(of_truth()),
              HasSubstr("truth.tum: 10 of 11 positions, after rigid alignment\n"
                        "  absolute trajectory error, m: rmse 0.3000, mean 0.2500, max 0.5000\n"
                        "  stamps: 10 exact, 0 within 2 ms, 1 unmatched\n"
                        "  not in the truth: 7.000000\n"));
}

TEST(EvaluationText, SaysFirstThatMostOfItWasNotCompared) {
  PathError error;
  error.position.pairs = 1;
  error.stamps = {1, 0, {at_us(7'000'000), at_us(8'000'000)}, 0};
  EXPECT_THAT(evaluation_text(evaluation_of({"truth.tum", error})),
              testing::StartsWith("WARNING: truth.tum: only 1 of 3 positions have stamps that match; the "
                                  "figures are of those alone\ntrajectory.tum: "));
  error.stamps.unmatched.pop_back();
  EXPECT_THAT(evaluation_text(evaluation_of({"truth.tum", error})), testing::StartsWith("trajectory.tum: "));
  error.stamps.between = 4;
  EXPECT_THAT(evaluation_text(evaluation_of({"truth.tum", error})),
              HasSubstr("0 within 2 ms, 4 interpolated or within 20 ms, 1 unmatched\n"));
}

TEST(EvaluationText, TellsWhatOfAFlightWasDrawn) {
  EXPECT_THAT(evaluation_text(of_flight()),
              HasSubstr("flight.pcap: 3000 of 3001 samples drawn along the trajectory\n"
                        "  returns of 0.05 to 2 m: 9001, in 3436 cells of 0.1 m, 1760 cells of 0.2 m\n"
                        "  samples without a pose within 2 ms, drawn between poses: 12\n"
                        "  samples outside the trajectory's time: 1, at 8.000000\n"
                        "  range packets without dead reckoning, not drawn: 2\n"));
}

TEST(EvaluationJson, HoldsAllFiguresOfRelations) {
  const json report = json::parse(evaluation_json(of_relations()));
  EXPECT_EQ(report["trajectory"]["poses"], 3816);
  EXPECT_EQ(report["trajectory"]["last_stamp_s"], 1627252704.955267);
  const json& reference = report["references"].at(0);
  EXPECT_EQ(reference["file"], "intel.relations");
  EXPECT_EQ(reference["kind"], "relations");
  EXPECT_EQ(reference["relations"], 6);
  EXPECT_EQ(reference["missed"], 2);
  EXPECT_EQ(reference["all"], (json{{"count", 4},
                                    {"translation_m", {{"mean", 0.2}, {"std", 0.18708}, {"max", 0.5}}},
                                    {"rotation_deg", {{"mean", 1.25}, {"std", 1.299}, {"max", 3.0}}}}));
  EXPECT_EQ(reference["over_100_s"],
            (json{{"count", 0}, {"translation_m", nullptr}, {"rotation_deg", nullptr}}));
  EXPECT_EQ(reference["each_translation_m"], json({0.5, nullptr, 0.25, 0.0, nullptr, 0.05}));
  EXPECT_EQ(reference["stamps"]["unmatched"], 5);
  EXPECT_EQ(reference["stamps"]["unmatched_s"], json({1.0, 2.5, 3.0, 1629657168.376475, 5e-6}));
}

TEST(EvaluationJson, HoldsAllFiguresOfPositionsAndFlights) {
  const json truth = json::parse(evaluation_json(of_truth()))["references"][0];
  EXPECT_EQ(truth["kind"], "truth");
  EXPECT_EQ(truth["pairs"], 10);
  EXPECT_EQ(truth["rmse_m"], 0.3);
  EXPECT_EQ(truth["max_m"], 0.5);
  EXPECT_EQ(truth["T_truth_estimate"]["yaw_deg"], 90.0);
  const json flight = json::parse(evaluation_json(of_flight()))["references"][0];
  EXPECT_EQ(flight["kind"], "flight");
  EXPECT_EQ(flight["samples"], 3001);
  EXPECT_EQ(flight["cells_10_cm"], 3436);
  EXPECT_EQ(flight["cells_20_cm"], 1760);
  EXPECT_EQ(flight["outside_s"], json({8.0}));
  EXPECT_EQ(flight["unpaired"], 2);
  EXPECT_EQ(flight["problems"], json({"damaged"}));
}

TEST(EvaluationJson, ReplacesWhatInAFileNameIsNoUtf8) {
  Evaluation evaluation = of_truth();
  evaluation.trajectory_file = "\xFF.tum";
  EXPECT_FALSE(json::parse(evaluation_json(evaluation)).is_discarded());
}

}  // namespace
}  // namespace swiftlet
