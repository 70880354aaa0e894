// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "core/backend/config/backend_config.hpp"
#include "core/backend/loop_closing/correlative_matcher.hpp"
#include "core/backend/loop_closing/cross_check.hpp"
#include "core/backend/loop_closing/loop_closure.hpp"
#include "core/backend/loop_closing/submap.hpp"
#include "core/backend/store/keyframe_chain.hpp"

namespace swiftlet {

/// Looks for one query, the recent travel, anywhere in earlier submaps and with any heading: for a vehicle
/// that was moved while nobody watched. A slice is one submap. Views its arguments, which must outlive it.
/// One thread at a time; allocates.
class PlaceSearch {
 public:
  PlaceSearch(const BackendConfig& config, const ScanStore& scans, const KeyframeChain& chain)
      : config_(&config), scans_(&scans), chain_(&chain) {}

  /// Begins with the travel that ends at keyframe `query`, if that has hits enough. `recent`: its scans.
  /// `submaps`: may overlap by half, so that every second one is searched.
  void begin(KeyframeId query, const ScanRange& recent,
             std::span<const std::shared_ptr<const Submap>> submaps, const KeyframePoses& T_local_keyframe);
  /// Searches the next submap. Precondition: is_busy().
  void step();
  [[nodiscard]] bool is_busy() const { return !left_.empty(); }
  /// What was found in all submaps of the query; empties it.
  [[nodiscard]] std::vector<LoopClosure> take_found() { return std::exchange(found_, {}); }
  void stop();

 private:
  [[nodiscard]] std::optional<MatchResult> match_anywhere(const Submap& submap) const;

  const BackendConfig* config_;
  const ScanStore* scans_;
  const KeyframeChain* chain_;
  KeyframeId query_{};
  std::vector<Point2> points_query_;
  std::vector<Point2> coarse_points_query_;  // of about as many cells as they are fewer
  std::optional<CrossCheck> cross_check_;
  std::vector<std::shared_ptr<const Submap>> left_;  // to be searched
  std::vector<LoopClosure> found_;
};

}  // namespace swiftlet
