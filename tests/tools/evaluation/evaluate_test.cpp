// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "tools/evaluation/evaluate.hpp"

#include <gmock/gmock.h>

#include <chrono>

#include "tests/firmware_link/synthetic_capture.hpp"
#include "tests/support/temporary_file.hpp"

namespace swiftlet {
namespace {

using std::chrono::milliseconds;
using testing::AllOf;
using testing::HasSubstr;
using testing::StartsWith;

HostTime at_ms(std::int64_t ms) { return HostTime(milliseconds(ms)); }

StampedPath straight_path() {
  return StampedPath({{at_ms(1000), Pose2()}, {at_ms(2000), Pose2(1.0, 0.0, 0.0)}});
}

TEST(Evaluate, MeasuresByTheKindOfTheReference) {
  const TemporaryFile relations("a", "1 2 1.5 0 0 0 0 0\n");
  const auto motions = evaluate_against(straight_path(), relations.path(), ReferenceKind::kRelations);
  ASSERT_TRUE(motions.ok()) << motions.error().message;
  EXPECT_EQ(motions->file, relations.path());
  EXPECT_NEAR(std::get<RelationError>(motions->figures).all.translation_m.mean, 0.5, 1e-12);

  const TemporaryFile truth("b", "2 0 1.5 0 0 0 0 1\n1 0 0 0 0 0 0 1\n");
  const auto positions = evaluate_against(straight_path(), truth.path(), ReferenceKind::kTruth);
  ASSERT_TRUE(positions.ok()) << positions.error().message;
  EXPECT_NEAR(std::get<PathError>(positions->figures).position.max_m, 0.25, 1e-12);
}

TEST(Evaluate, CountsWhatACaptureLeavesUndrawn) {
  const TemporaryFile capture("flight.pcap");
  write_capture(capture.path(), SyntheticCapture().frames());
  const StampedPath path({{at_ms(1'700'000'001'300), Pose2()}, {at_ms(1'700'000'001'500), Pose2()}});
  const auto flight = evaluate_against(path, capture.path(), ReferenceKind::kFlight);
  ASSERT_TRUE(flight.ok()) << flight.error().message;
  const auto& result = std::get<FlightResult>(flight->figures);
  EXPECT_EQ(result.sharpness.drawn, 3U);
  EXPECT_EQ(result.sharpness.outside.size(), 4U);
  EXPECT_EQ(result.input.counters.unpaired, 1U) << "the ranges are older than the first dead reckoning";
}

TEST(Evaluate, RefusesAReferenceThatHasNothingInCommonAndNamesBothTimes) {
  const TemporaryFile relations("a", "1 7 1 0 0 0 0 0\n5 2 1 0 0 0 0 0\n");
  const TemporaryFile truth("b", "5 0 1 0 0 0 0 1\n7 0 0 0 0 0 0 1\n");
  const TemporaryFile capture("flight.pcap");
  write_capture(capture.path(), SyntheticCapture().frames());
  const auto refusal = [](const TemporaryFile& file, ReferenceKind kind) {
    const auto result = evaluate_against(straight_path(), file.path(), kind);
    return result ? "accepted" : result.error().message;
  };
  const auto names = [](const TemporaryFile& file, const char* times) {
    return AllOf(StartsWith(file.path() + ": "), HasSubstr(times),
                 HasSubstr("the trajectory's from 1.000000 to 2.000000 s; are they of one run"));
  };
  EXPECT_THAT(refusal(relations, ReferenceKind::kRelations), names(relations, "from 1.000000 to 7.000000 s"));
  EXPECT_THAT(refusal(truth, ReferenceKind::kTruth), names(truth, "from 5.000000 to 7.000000 s"));
  EXPECT_THAT(refusal(capture, ReferenceKind::kFlight),
              names(capture, "from 1700000001.100000 to 1700000001.700000 s"));
}

TEST(Evaluate, RefusesAReferenceThatCannotBeRead) {
  for (const ReferenceKind kind : {ReferenceKind::kRelations, ReferenceKind::kTruth, ReferenceKind::kFlight})
    EXPECT_EQ(evaluate_against(straight_path(), "/nonexistent/a.pcap", kind).error().code,
              ErrorCode::kNotFound);
}

}  // namespace
}  // namespace swiftlet
