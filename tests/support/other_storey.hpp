// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <memory>
#include <utility>
#include <vector>

#include "core/backend/loop_closing/submap.hpp"

namespace swiftlet {

/// The same submaps on the storey above the lowest one.
inline std::vector<std::shared_ptr<const Submap>> one_storey_up(
    const std::vector<std::shared_ptr<const Submap>>& submaps) {
  std::vector<std::shared_ptr<const Submap>> above;
  above.reserve(submaps.size());
  for (const auto& submap : submaps) {
    Submap other = *submap;
    other.storey = StoreyId{1};
    above.push_back(std::make_shared<const Submap>(std::move(other)));
  }
  return above;
}

}  // namespace swiftlet
