// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "core/backend/store/scan_store.hpp"
#include "core/geometry/pose2.hpp"

namespace swiftlet {

/// Places every scan between the keyframes: dead reckoning from the keyframe before, with what it misses at
/// the next keyframe spread along the way. Views the scan store, which must outlive it. One thread at a time.
class KeyframeChain {
 public:
  explicit KeyframeChain(const ScanStore& scans) : scans_(&scans) {}

  /// The next keyframe (ids are consecutive) was made by this scan.
  void add(ScanIndex scan) { scan_of_keyframe_.push_back(scan); }
  /// Follows the scan store, from which the same were removed.
  void remove(const IndexRemoval& scans, const IndexRemoval& keyframes) {
    keyframes.apply(scan_of_keyframe_);
    for (ScanIndex& scan : scan_of_keyframe_) scan = scans.new_index(scan);
  }
  [[nodiscard]] std::size_t size() const { return scan_of_keyframe_.size(); }
  [[nodiscard]] ScanIndex scan_of(KeyframeId id) const { return scan_of_keyframe_[index_of(id)]; }
  /// Travelled from the start of the run to the keyframe.
  [[nodiscard]] double path_m(KeyframeId id) const { return (*scans_)[scan_of(id)].path_m; }

  /// T_w_body of a scan, given T_w_keyframe of all keyframes in any one frame w.
  [[nodiscard]] Pose2 T_w_body(ScanIndex scan, std::span<const Pose2> T_w_keyframe) const;
  /// Of consecutive scans, or every so many of them, for less than one by one. Allocates.
  [[nodiscard]] std::vector<Pose2> T_w_bodies(const ScanRange& scans, std::span<const Pose2> T_w_keyframe,
                                              ScanIndex every = 1) const;

 private:
  /// From one keyframe to the next: what dead reckoning misses at its end, none where that is not known.
  struct Stretch {
    ScanIndex first = 0;
    ScanIndex last = 0;
    std::optional<Pose2> missed;
  };
  [[nodiscard]] Stretch stretch_after(KeyframeId keyframe, std::span<const Pose2> T_w_keyframe) const;
  [[nodiscard]] Pose2 T_w_body(ScanIndex scan, const Stretch& stretch,
                               std::span<const Pose2> T_w_keyframe) const;

  const ScanStore* scans_;
  std::vector<ScanIndex> scan_of_keyframe_;
};

}  // namespace swiftlet
