// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "core/backend/config/backend_config.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace swiftlet {
namespace {

using testing::Contains;
using testing::Each;
using testing::ElementsAre;
using testing::IsEmpty;
using testing::StartsWith;

TEST(BackendConfig, DefaultsAreUsable) { EXPECT_THAT(BackendConfig().validate(), IsEmpty()); }

TEST(BackendConfig, AKernelHasAMiddle) {
  BackendConfig config;
  config.max_kernel_cells = 4;
  EXPECT_THAT(config.validate(), ElementsAre("backend.max_kernel_cells must be odd"));
}

TEST(BackendConfig, AllProblemsAreListedAtOnce) {
  BackendConfig config;
  config.submap_length_m = 0.0;
  config.grid_resolution_m = 2.0;
  config.hit_probability = 0.4;
  config.miss_probability = 0.6;
  config.max_kernel_cells = 0;
  config.multiscan_length_m = -1.0;
  config.match_every_keyframes = 0;
  config.min_travel_between_m = -0.1;
  config.search_radius_m = 0.0;
  config.search_angle_rad = 4.0;
  config.max_candidates = 0;
  config.min_score = 1.0;
  config.min_match_points = 2;
  config.dcs_phi = 0.0;
  config.drop_scale = 1.0;
  config.optimizer_iterations = 0;
  config.refinement_iterations = 0;
  config.max_scans = 999;
  const std::vector<std::string> problems = config.validate();
  EXPECT_THAT(problems, Each(StartsWith("backend.")));
  for (const char* key :
       {"submap_length_m", "grid_resolution_m", "hit_probability", "miss_probability", "max_kernel_cells",
        "multiscan_length_m", "match_every_keyframes", "min_travel_between_m", "search_radius_m",
        "search_angle_rad", "max_candidates", "min_score", "min_match_points", "dcs_phi", "drop_scale",
        "optimizer_iterations", "refinement_iterations", "max_scans"}) {
    EXPECT_THAT(problems, Contains(StartsWith(std::string("backend.") + key + " = "))) << key;
  }
}

}  // namespace
}  // namespace swiftlet
