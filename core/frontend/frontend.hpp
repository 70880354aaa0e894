// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <cstdint>
#include <memory>

#include "core/frontend/frontend_config.hpp"
#include "core/sensing/keyframe.hpp"
#include "core/sensing/range_sample.hpp"
#include "core/sensing/sensor_model.hpp"

namespace swiftlet {

/// Counts since the start, for status and reports.
struct FrontendCounters {
  std::uint64_t samples = 0;
  std::uint64_t keyframes = 0;
  std::uint64_t lines_extracted = 0;
  std::uint64_t observations_added = 0;   ///< line observations inserted in the graph
  std::uint64_t batches_rolled_back = 0;  ///< failed the chi-square check (eq. 19)
  std::uint64_t landmarks_created = 0;
  std::uint64_t landmarks_retired = 0;
  std::uint64_t poses_retired = 0;
  std::uint64_t refused_full = 0;  ///< landmarks, observations or points without room
};

/// Algorithm 1 of "Efficient 2D Graph SLAM for Sparse Sensing" (Zhou, Hu, Liu, Khan; IROS 2022): each call
/// takes a sample and returns its pose, and a keyframe where the sample is one.
/// @note Fixed storage: allocates in the constructor only. One thread at a time. Throws nothing.
class Frontend {
 public:
  /// Precondition: config.validate() is empty.
  Frontend(const FrontendConfig& config, const SensorModel& sensor, const BeamLayout& beams);
  ~Frontend();
  Frontend(const Frontend&) = delete;
  Frontend& operator=(const Frontend&) = delete;

  /// `T_map_local`: the present correction of the map, used for FrontendStep::T_map_body only. The result is
  /// valid until the next call.
  const FrontendStep& process(const RangeSample& sample, const Pose2& T_map_local = Pose2()) noexcept;
  [[nodiscard]] const FrontendCounters& counters() const noexcept;

 private:
  struct State;
  std::unique_ptr<State> state_;  // allocated once; fixed size
};

}  // namespace swiftlet
