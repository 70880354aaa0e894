// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "tools/evaluation/live_evaluation.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <sstream>
#include <string>

#include "tests/support/temporary_file.hpp"

namespace swiftlet {
namespace {

using testing::AllOf;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::StartsWith;

/// A robot that drives along a wall from 100 to 110 s.
std::string short_log() {
  std::ostringstream text;
  for (int i = 0; i <= 50; ++i) {
    text << "FLASER 180";
    for (int beam = 0; beam < 180; ++beam) text << (beam < 90 ? " 2.0" : " 3.0");
    const double x_m = 0.1 * i;
    text << " " << x_m << " 0 0 " << x_m << " 0 0 " << 100.0 + 0.2 * i << " host " << 0.2 * i << "\n";
  }
  return text.str();
}

TEST(LiveEvaluation, ReportsTheNotesOfTheInputAndWhatIsWrongWithIt) {
  const TemporaryFile whole("whole.clf", short_log());
  const Result<LiveEvaluation> sound = evaluate_live({whole.path(), "", "", {}});
  ASSERT_TRUE(sound) << sound.error().message;
  EXPECT_THAT(sound->report.problems, IsEmpty());
  EXPECT_THAT(sound->report.notes, Contains(HasSubstr("dead reckoning from the FLASER lines")));

  const TemporaryFile garbled("garbled.clf", short_log() + "FLASER 180 garbled\n");
  const Result<LiveEvaluation> damaged = evaluate_live({garbled.path(), "", "", {}});
  ASSERT_TRUE(damaged) << damaged.error().message;
  EXPECT_EQ(damaged->poses.size(), 51U);
  EXPECT_THAT(damaged->report.problems, ElementsAre(HasSubstr("garbled.clf:52: FLASER line cut off")));
}

TEST(LiveEvaluation, CalibratesFirstWhereItIsNotToldToLeaveThat) {
  const auto tells_of_age = [](bool calibrate) {
    const Result<LiveEvaluation> evaluation = evaluate_live({"sim://patrol?seed=1", "", "", {}, calibrate});
    return evaluation && std::ranges::any_of(evaluation->report.notes, [](const std::string& note) {
             return note.find("age of the ranges") != std::string::npos;
           });
  };
  EXPECT_TRUE(tells_of_age(true));
  EXPECT_FALSE(tells_of_age(false));
}

TEST(LiveEvaluation, RefusesATruthOfAnotherTimeAndNamesBoth) {
  const TemporaryFile log("log.clf", short_log());
  const TemporaryFile truth("truth.tum", "7 0 0 0 0 0 0 1\n5 0 0 0 0 0 0 1\n");
  const Result<LiveEvaluation> evaluation = evaluate_live({log.path(), truth.path(), "", {}});
  ASSERT_FALSE(evaluation);
  EXPECT_EQ(evaluation.error().code, ErrorCode::kInvalidInput);
  EXPECT_THAT(
      evaluation.error().message,
      AllOf(StartsWith(truth.path() + ": has no pose within 2 ms of any"),
            HasSubstr("from 5.000000 to 7.000000 s, the trajectory's from 100.000000 to 110.000000 s")));
}

TEST(LiveEvaluation, TakesATruthThatHasOnePoseInCommon) {
  const TemporaryFile log("log.clf", short_log());
  const TemporaryFile truth("truth.tum", "7 0 0 0 0 0 0 1\n102.001 1 0 0 0 0 0 1\n");
  const Result<LiveEvaluation> evaluation = evaluate_live({log.path(), truth.path(), "", {}});
  EXPECT_TRUE(evaluation) << evaluation.error().message;
}

TEST(LiveEvaluation, ReadsTheTruthBeforeTheInput) {
  const TemporaryFile truth("truth.tum", "1 2 3\n");
  const Result<LiveEvaluation> evaluation = evaluate_live({"/nonexistent/a.pcap", truth.path(), "", {}});
  ASSERT_FALSE(evaluation);
  EXPECT_THAT(evaluation.error().message, HasSubstr("truth.tum:1: has 3 columns"));
}

}  // namespace
}  // namespace swiftlet
