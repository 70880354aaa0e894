// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "daemon/outputs/map_notes.hpp"

#include <gmock/gmock.h>

namespace swiftlet {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

TEST(MapNotes, AreNoneOfTheUsualMap) { EXPECT_THAT(map_notes({}), IsEmpty()); }

TEST(MapNotes, SayWhatAMapFollowsThatFollowsNoClosures) {
  BackendCounters counters;
  counters.map_source = MapSource::kDeadReckoning;
  EXPECT_THAT(map_notes(counters), ElementsAre(HasSubstr("follows dead reckoning alone")));
  counters.map_source = MapSource::kFrontend;
  EXPECT_THAT(map_notes(counters), ElementsAre(HasSubstr("follows frontend alone")));
}

TEST(MapNotes, SayHowARunWasMappedAgain) {
  BackendCounters counters;
  counters.map_source = MapSource::kOtherYawNoise;
  counters.yaw_noise_factor = 0.25;
  EXPECT_THAT(map_notes(counters), ElementsAre(HasSubstr("mapped again with 0.25 times the noise")));
  counters.map_source = MapSource::kBackwards;
  EXPECT_THAT(map_notes(counters), ElementsAre(HasSubstr("from its end to its start")));
  counters.map_source = MapSource::kFloorKnown;
  counters.floor_cost = 3.0;
  EXPECT_THAT(map_notes(counters), ElementsAre(HasSubstr("over some floors")));
}

}  // namespace
}  // namespace swiftlet
