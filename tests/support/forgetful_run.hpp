// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <cstdint>
#include <vector>

#include "core/backend/backend.hpp"
#include "core/frontend/frontend.hpp"
#include "tests/support/scripted_sample_source.hpp"

namespace swiftlet {

/// Many rounds in one room, through a backend that may hold few scans.
struct ForgetfulRun {
  static BackendConfig config() {
    BackendConfig config;
    config.max_scans = 1000;
    return config;
  }

  /// Calls `before_retiring` with each pruning, while the backend still has the scans, and `after_step`
  /// after each step with what it did.
  template <typename BeforeRetiring, typename AfterStep>
  void fly(BeforeRetiring before_retiring, AfterStep after_step) {
    for (const RangeSample& sample : samples) {
      FrontendStep step = frontend.process(sample);
      if (step.has_keyframe)  // and a wall that nobody sees again
        (void)step.made.landmarks.try_push_back(
            {make_id<LandmarkId>(100'000 + index_of(step.made.id)), {0.0, 1.0}, {0.5, 1.0}});
      const BackendUpdate update = backend.add(step);
      after_step(update);
      const Pruning pruning = backend.next_pruning();
      if (pruning.empty()) continue;
      before_retiring(pruning);
      backend.prune(pruning);
      pruned_scans += pruning.scan_count;
    }
  }
  template <typename BeforeRetiring>
  void fly(BeforeRetiring before_retiring) {
    fly(before_retiring, [](const BackendUpdate&) {});
  }

  SensorModel sensor = SensorModel::crazyflie();
  std::vector<RangeSample> samples = flight_in_square_room(3500, 2.6, 1.6);
  Frontend frontend{FrontendConfig{}, sensor, BeamLayout::multiranger()};
  Backend backend{config(), sensor, BeamLayout::multiranger()};
  std::size_t pruned_scans = 0;
};

}  // namespace swiftlet
