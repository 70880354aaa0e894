// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "tools/doctor/report.hpp"

#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

namespace swiftlet {
namespace {

using testing::HasSubstr;
using testing::Not;

const Findings kFindings{{Mark::kOk, "dongle", "Crazyradio 2.0", ""},
                         {Mark::kProblem, "permission", "may not open it", "run this"},
                         {Mark::kSkipped, "decks", "the vehicle was not asked", ""}};

TEST(ReportText, HasOneLineForEachFindingAndOneForAll) {
  EXPECT_EQ(report_text(kFindings, false),
            "ok       dongle      Crazyradio 2.0\n"
            "problem  permission  may not open it -> run this\n"
            "skipped  decks       the vehicle was not asked\n"
            "\n"
            "1 problem, 0 warnings: not ready; solve the first problem first, then ask again\n");
}

TEST(ReportText, NeighboursSkippedForOneReasonShareALine) {
  EXPECT_THAT(report_text({{Mark::kSkipped, "a", "no dongle", ""},
                           {Mark::kSkipped, "b", "no dongle", ""},
                           {Mark::kSkipped, "c", "no dongle", ""},
                           {Mark::kSkipped, "d", "not told", ""},
                           {Mark::kOk, "e", "good", ""},
                           {Mark::kSkipped, "f", "not told", ""}},
                          false),
              HasSubstr("skipped  a  no dongle; likewise b, c\n"
                        "skipped  d  not told\n"
                        "ok       e  good\n"
                        "skipped  f  not told\n"));
}

TEST(ReportText, SaysThatNothingStopsAFlight) {
  EXPECT_THAT(report_text({{Mark::kWarning, "a", "b", "c"}}, false),
              HasSubstr("\n0 problems, 1 warning: nothing stops a flight\n"));
}

TEST(ReportText, IsColouredOnRequest) {
  EXPECT_THAT(report_text(kFindings, true), HasSubstr("\033[1;31mproblem\033[0m  permission"));
  EXPECT_THAT(report_text(kFindings, false), Not(HasSubstr("\033")));
}

TEST(ReportJson, SaysTheSameToPrograms) {
  const auto report = nlohmann::json::parse(report_json("usb://0", kFindings));
  EXPECT_EQ(report["input"], "usb://0");
  EXPECT_EQ(report["ready"], false);
  ASSERT_EQ(report["checks"].size(), 3U);
  EXPECT_EQ(report["checks"][1]["check"], "permission");
  EXPECT_EQ(report["checks"][1]["mark"], "problem");
  EXPECT_EQ(report["checks"][1]["remedy"], "run this");
}

TEST(ReportJson, SurvivesTextsThatAreNoUtf8) {
  const std::string text = report_json("usb://0", {{Mark::kOk, "dongle", "\xff\xfe", ""}});
  EXPECT_EQ(nlohmann::json::parse(text)["ready"], true);
}

}  // namespace
}  // namespace swiftlet
