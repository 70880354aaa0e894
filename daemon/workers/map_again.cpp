// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "daemon/workers/map_again.hpp"

#include <future>
#include <optional>
#include <utility>

#include "core/run/other_yaw_noise.hpp"

namespace swiftlet {

std::vector<OtherPath> map_again(const Backend& backend, const MappingSettings& settings,
                                 std::span<const double> step_scale) {
  if (!backend.can_be_mapped_again()) return {};
  std::vector<RangeSample> samples = backend.scans().samples();
  std::vector<double> factors(kOtherYawNoise.begin(), kOtherYawNoise.end());
  if (!step_scale.empty()) {
    stretch_steps(samples, step_scale);
    factors = {1.0};
  }
  std::vector<std::future<std::optional<OtherPath>>> begun;
  begun.reserve(factors.size());
  for (const double factor : factors)
    begun.push_back(std::async([&, factor] {  // in this thread where the system has no other to give
      return path_with_yaw_noise(factor, samples, settings, backend.scans().beams());
    }));
  std::vector<OtherPath> others;
  for (std::future<std::optional<OtherPath>>& path : begun)
    if (std::optional<OtherPath> other = path.get()) others.push_back(std::move(*other));
  return others;
}

}  // namespace swiftlet
