// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <optional>
#include <vector>

#include "core/backend/store/scan_store.hpp"
#include "core/base/check.hpp"
#include "core/base/id_map.hpp"
#include "core/geometry/pose2.hpp"

namespace swiftlet {

/// Poses of keyframes in one frame.
using KeyframePoses = IdMap<KeyframeId, Pose2>;

/// Places every scan between the keyframes: dead reckoning from the keyframe before, with what it misses at
/// the next keyframe spread along the way. Views the scan store, which must outlive it. One thread at a time.
class KeyframeChain {
 public:
  explicit KeyframeChain(const ScanStore& scans) : scans_(&scans) {}

  /// Adds the next keyframe, made by this scan.
  KeyframeId add(ScanId scan) { return scan_of_keyframe_.push_back(scan); }
  void erase(const IdRanges<KeyframeId>& pruned) { scan_of_keyframe_.erase(pruned); }
  [[nodiscard]] std::size_t size() const { return scan_of_keyframe_.size(); }
  /// The keyframes with the scans that made them.
  [[nodiscard]] const IdMap<KeyframeId, ScanId>& all() const { return scan_of_keyframe_; }
  [[nodiscard]] ScanId scan_of(KeyframeId id) const { return scan_of_keyframe_[id]; }
  /// The scans from one keyframe to another; `end` may be behind the newest.
  [[nodiscard]] ScanRange scans_of(const IdRange<KeyframeId>& keyframes) const {
    const KeyframeId end = scan_of_keyframe_.at_or_after(keyframes.end);
    return {scan_of(keyframes.first),
            end < scan_of_keyframe_.end_id() ? scan_of(end) : scans_->all().end_id()};
  }
  /// Travelled from the start of the run to the keyframe.
  [[nodiscard]] double path_m(KeyframeId id) const { return (*scans_)[scan_of(id)].path_m; }
  [[nodiscard]] StoreyId storey(KeyframeId id) const { return (*scans_)[scan_of(id)].storey; }

  /// T_w_body of a scan, given T_w_keyframe of all keyframes in any one frame w; the newest may be missing.
  [[nodiscard]] Pose2 T_w_body(ScanId scan, const KeyframePoses& T_w_keyframe) const;
  /// Of a range of scans, or every so many of them, for less than one by one. Allocates.
  [[nodiscard]] std::vector<Pose2> T_w_bodies(const ScanRange& scans, const KeyframePoses& T_w_keyframe,
                                              std::size_t every = 1) const;

 private:
  /// From one keyframe to the next: what dead reckoning misses at its end, none where that is not known.
  struct Stretch {
    Pose2 T_w_keyframe;
    std::size_t first = 0;  // position of the keyframe's scan in the store
    std::size_t steps = 0;  // scans to the next keyframe's
    std::optional<Pose2> missed;
  };
  [[nodiscard]] Stretch stretch_after(KeyframeId keyframe, const KeyframePoses& T_w_keyframe) const;
  [[nodiscard]] Pose2 T_w_body(std::size_t position, const Stretch& stretch) const;

  const ScanStore* scans_;
  IdMap<KeyframeId, ScanId> scan_of_keyframe_;
};

}  // namespace swiftlet
