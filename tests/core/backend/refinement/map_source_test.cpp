// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "core/backend/refinement/map_source.hpp"

#include <gtest/gtest.h>

namespace swiftlet {
namespace {

TEST(MapSource, DeadReckoningAndFrontendFollowNoClosures) {
  EXPECT_FALSE(follows_closures(MapSource::kDeadReckoning));
  EXPECT_FALSE(follows_closures(MapSource::kFrontend));
  for (const MapSource source :
       {MapSource::kPoseGraph, MapSource::kOtherYawNoise, MapSource::kBackwards, MapSource::kFloorKnown})
    EXPECT_TRUE(follows_closures(source)) << name_of(source);
}

}  // namespace
}  // namespace swiftlet
