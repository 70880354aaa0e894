// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "firmware_link/sample/sign_mending_source.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <memory>
#include <string>
#include <utility>

#include "firmware_link/input/open_sample_source.hpp"
#include "tests/support/reference_data.hpp"
#include "tests/support/scripted_sample_source.hpp"

namespace swiftlet {
namespace {

using testing::Contains;
using testing::HasSubstr;

/// Plays all of a log, thinned to `beams`.
std::unique_ptr<SignMendingSource> played(const std::string& path, int beams) {
  SampleSourceOptions options;
  options.beam_count = beams;
  auto log = open_sample_source(path, options);
  if (!log) return nullptr;
  auto source = std::make_unique<SignMendingSource>(std::move(log).value());
  while (source->next()) {
  }
  source->end();
  return source;
}

TEST(SignMendingSource, DeliversAllBeforeItSaysWhatEndedTheRecording) {
  SignMendingSource source(std::make_unique<ScriptedSampleSource>(flight_in_square_room(100, 2.0, 1.0),
                                                                  Error{ErrorCode::kDamaged, "torn off"}));
  for (std::uint32_t i = 0; i < 100; ++i) {
    const Result<ReceivedSample> received = source.next();
    ASSERT_TRUE(received) << i;
    EXPECT_EQ(received->sample.sequence, i);
  }
  for (int i = 0; i < 2; ++i) EXPECT_EQ(source.next().error().message, "torn off");
  source.end();
  EXPECT_EQ(source.report().counters.samples, 100U);
  EXPECT_TRUE(source.report().notes.empty());
  EXPECT_TRUE(source.mended().empty());
}

TEST(SignMendingSource, ReportsWhatWasReadWithTheSampleDelivered) {
  SignMendingSource source(std::make_unique<ScriptedSampleSource>(flight_in_square_room(100, 2.0, 1.0)));
  EXPECT_EQ(source.report().counters.samples, 0U);
  for (std::uint32_t i = 0; i < 100; ++i) {
    ASSERT_TRUE(source.next()) << i;
    EXPECT_EQ(source.report().counters.samples, i + 1);
    ASSERT_TRUE(source.progress());
    EXPECT_DOUBLE_EQ(*source.progress(), (i + 1) / 100.0);
  }
}

TEST(SignMendingSource, ReportsTheWayTakenAsReversed) {
  const std::string path = reference_file("radish/fr079.clf.gz");
  SWIFTLET_REQUIRE_REFERENCE(path);
  for (const int beams : {4, 11, 61}) {
    const auto source = played(path, beams);
    ASSERT_NE(source, nullptr);
    const double shown_m = beams == 4 ? 9.8 : 10.9;  // four beams show too little of the shortest stretches
    EXPECT_NEAR(source->report().reversed_m, shown_m, 0.8) << beams;
    EXPECT_THAT(source->report().notes, Contains(HasSubstr("taken as driven in reverse")));
  }
}

TEST(SignMendingSource, LeavesOdometryWithSignsAlone) {
  for (const char* name : {"radish/aces.clf.gz", "radish/fr-clinic.clf.gz"}) {
    const std::string path = reference_file(name);
    SWIFTLET_REQUIRE_REFERENCE(path);
    for (const int beams : {4, 11}) {
      const auto source = played(path, beams);
      ASSERT_NE(source, nullptr);
      EXPECT_TRUE(source->mended().empty()) << name << ", " << beams << " beams";
    }
  }
}

}  // namespace
}  // namespace swiftlet
