// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "daemon/workers/map_again.hpp"

#include <future>
#include <optional>
#include <utility>

#include "core/run/other_yaw_noise.hpp"

namespace swiftlet {

std::vector<OtherPath> map_again(const Backend& backend, const MappingSettings& settings) {
  if (!backend.can_be_mapped_again()) return {};
  const std::vector<RangeSample> samples = backend.scans().samples();
  std::vector<std::future<std::optional<OtherPath>>> begun;
  begun.reserve(kOtherYawNoise.size());
  for (const double factor : kOtherYawNoise)
    begun.push_back(std::async([&, factor] {  // in this thread where the system has no other to give
      return path_with_yaw_noise(factor, samples, settings, backend.scans().beams());
    }));
  std::vector<OtherPath> others;
  for (std::future<std::optional<OtherPath>>& path : begun)
    if (std::optional<OtherPath> other = path.get()) others.push_back(std::move(*other));
  return others;
}

}  // namespace swiftlet
