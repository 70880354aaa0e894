// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include <gmock/gmock.h>

#include <chrono>
#include <nlohmann/json.hpp>

#include "tools/evaluation/live_evaluation.hpp"

namespace swiftlet {
namespace {

using nlohmann::json;
using testing::HasSubstr;

LiveEvaluation some_flight() {
  LiveEvaluation evaluation{"hall.pcap", {}, {}, {}};
  evaluation.consistency.at[1] = {.path_m = 20.25, .nees = 3.5, .error_m = 0.125, .sigma_m = 0.25};
  evaluation.consistency.alarms.alarms = 4;
  evaluation.consistency.alarms.false_alarms = 1;
  evaluation.consistency.alarms.unjudged_alarms = 2;
  KnownPlaceError& live = evaluation.live;
  live.moments = 2;
  live.rms_m = 0.25;
  live.share_off = 0.5;
  live.across_p95_m = 0.125;
  live.across_m = {0.125};
  live.settled_s = {2.5, 7.0};
  live.contacts = 3;
  live.map_rms_m[0] = 0.375;
  evaluation.poses = {{.stamp = HostTime(std::chrono::seconds(7)),
                       .T_map_body = Pose2(1.5, -2.0, 0.25),
                       .from_start = {.xx = 5.0, .xy = 4.0, .yy = 5.0},
                       .from_surroundings = {.xx = 1.0, .yy = 0.25},
                       .state = "lost"}};
  live.errors = {{HostTime(std::chrono::seconds(7)), 0.125}, {HostTime(std::chrono::seconds(8)), 0.375}};
  return evaluation;
}

TEST(LiveReport, TellsPeopleWhatIsKnownAndWhatIsNot) {
  const std::string text = live_evaluation_text(some_flight());
  EXPECT_THAT(text, HasSubstr("hall.pcap: 2 poses at known places\n"));
  EXPECT_THAT(text, HasSubstr("rms 0.250, p95 0.000, max 0.000; beyond 0.3 m for 50.0 % of the time"));
  EXPECT_THAT(text, HasSubstr("across the nearest wall 0.125 m, along it unknown m"));
  EXPECT_THAT(text, testing::Not(HasSubstr("runs that end")));
  EXPECT_THAT(text, HasSubstr("after 20 m: off by 0.125 m and 0.000 rad, standard deviations 0.250 m"));
  EXPECT_THAT(text, HasSubstr("NEES 3.50"));
  EXPECT_THAT(text, HasSubstr("in doubt 4 times"));
  EXPECT_THAT(text, HasSubstr("1 times while off by less than 0.5 m, 2 times where no place was known\n"));
}

TEST(LiveReport, TellsProgramsAllOfIt) {
  LiveEvaluation evaluation = some_flight();
  EXPECT_FALSE(json::parse(live_evaluation_json(evaluation)).contains("batch"));
  evaluation.batch = BatchError{2, 0.1, 0.0, 0.2, 0.5};
  const json report = json::parse(live_evaluation_json(evaluation));
  EXPECT_EQ(report["input"], "hall.pcap");
  EXPECT_EQ(report["live"]["rms_m"], 0.25);
  EXPECT_EQ(report["live"]["along_p95_m"], nullptr);
  EXPECT_EQ(report["live"]["map_rms_m"], json({0.375, nullptr, nullptr}));
  EXPECT_EQ(report["live"]["errors_m"], json({{7.0, 0.125}, {8.0, 0.375}}));
  EXPECT_EQ(report["live"]["across_m"], json({0.125}));
  EXPECT_EQ(report["live"]["along_m"], json::array());
  EXPECT_EQ(report["live"]["settled_s"], json({2.5, 7.0}));
  EXPECT_EQ(report["batch"]["live_rms_m"], 0.2);
  EXPECT_EQ(report["consistency"]["after"][0]["nees"], 3.5);
  EXPECT_EQ(report["consistency"]["alarms"], 4);
  EXPECT_EQ(report["consistency"]["unjudged_alarms"], 2);
  EXPECT_EQ(report["poses"], json::array({{7.0, 1.5, -2.0, 0.25, 3.0, 1.0, "lost"}}));
}

TEST(LiveReport, OfNoKnownPlaceNothingIsKnown) {
  LiveEvaluation evaluation{"hall.pcap", {}, {}, {}};
  evaluation.batch = BatchError{};
  const std::string text = live_evaluation_text(evaluation);
  EXPECT_THAT(text, HasSubstr("hall.pcap: 0 poses at known places\n"));
  EXPECT_THAT(text,
              HasSubstr("rms unknown, p95 unknown, max unknown; beyond 0.3 m for unknown % of the time\n"));
  EXPECT_THAT(text, HasSubstr("off at first: 0, those below 0.2 m after unknown s (p50)\n"));
  EXPECT_THAT(text, HasSubstr("runs that end at 0 of the poses: rms unknown m, beyond 0.3 m unknown %; live "
                              "there unknown m, unknown %\n"));
  const json report = json::parse(live_evaluation_json(evaluation));
  EXPECT_EQ(report["live"]["moments"], 0);
  for (const char* key : {"rms_m", "p95_m", "max_m", "share_off", "settled_p50_s"})
    EXPECT_EQ(report["live"].at(key), nullptr) << key;
  EXPECT_EQ(report["batch"]["moments"], 0);
  for (const char* key : {"rms_m", "share_off", "live_rms_m", "live_share_off"})
    EXPECT_EQ(report["batch"].at(key), nullptr) << key;
}

TEST(LiveReport, TellsProgramsWhatIsWrongWithTheInput) {
  LiveEvaluation evaluation = some_flight();
  EXPECT_EQ(json::parse(live_evaluation_json(evaluation))["problems"], json::array());
  evaluation.report.problems = {"hall.pcap: damaged"};
  EXPECT_EQ(json::parse(live_evaluation_json(evaluation))["problems"], json({"hall.pcap: damaged"}));
}

}  // namespace
}  // namespace swiftlet
