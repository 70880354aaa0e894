// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "daemon/workers/map_again.hpp"

#include <functional>
#include <future>
#include <optional>
#include <utility>

#include "core/run/other_paths.hpp"

namespace swiftlet {

std::vector<OtherPath> map_again(const Backend& backend, const MappingSettings& settings,
                                 std::span<const double> step_scale) {
  if (!backend.can_be_mapped_again()) return {};
  using Path = std::optional<OtherPath>;
  std::vector<RangeSample> samples = backend.scans().samples();
  const BeamLayout& beams = backend.scans().beams();
  std::vector<std::function<Path()>> ways;
  if (step_scale.empty()) {
    for (const double factor : kOtherYawNoise)
      ways.emplace_back([&, factor] { return path_with_yaw_noise(factor, samples, settings, beams); });
    ways.emplace_back([&] { return path_backwards(samples, settings, beams); });
  } else {
    stretch_steps(samples, step_scale);
    ways.emplace_back([&] { return path_over_known_floor(samples, settings, beams); });
  }
  std::vector<std::future<Path>> begun;
  begun.reserve(ways.size());
  for (const std::function<Path()>& way : ways)
    begun.push_back(std::async(way));  // in this thread where the system has no other to give
  std::vector<OtherPath> others;
  for (std::future<Path>& path : begun)
    if (Path other = path.get()) others.push_back(std::move(*other));
  return others;
}

}  // namespace swiftlet
