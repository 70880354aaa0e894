// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <memory>
#include <vector>

#include "core/backend/backend.hpp"
#include "core/base/result.hpp"

namespace swiftlet {

/// One scan of a run as the trajectory files have it.
struct TrajectoryPoint {
  HostTime stamp{};
  Pose2 T_map_body;
  Pose2 T_odom_body;
  Pose2 T_map_live;
  StoreyId storey{};
};

/// Keeps on disk what the trajectories need of scans that the backend prunes, so that no sample is missing
/// from them. Each scan hangs on a keyframe that stays, and moves with it to the end of the run. One thread
/// at a time.
class PrunedScans {
 public:
  /// The file lies in the directory without a name and is gone with this object. kInvalidInput: it cannot be
  /// made.
  [[nodiscard]] static Result<PrunedScans> open(const std::filesystem::path& directory);

  /// Takes what the backend is about to prune. A failure is kept, and returned by for_each_scan().
  void take(const Backend& backend, const Pruning& pruning);

  /// Visits every scan of the run in order, those that the backend still has and those it has pruned.
  /// kOutOfSpace: the disk was full, or the file could not be read.
  [[nodiscard]] Status for_each_scan(const Backend& backend,
                                     const std::function<void(const TrajectoryPoint&)>& visit) const;

 private:
  struct CloseFile {
    void operator()(std::FILE* file) const { static_cast<void>(std::fclose(file)); }
  };
  /// Scans that lie one behind the other, in the run and in the file.
  struct Block {
    ScanId first{};
    std::uint32_t count = 0;
    std::uint32_t first_record = 0;
  };
  explicit PrunedScans(std::FILE* file) : file_(file) {}
  void write(const Backend& backend, ScanId scan, const Pose2& T_anchor_map, KeyframeId anchor);
  [[nodiscard]] bool visit_block(const Backend& backend, const Block& block,
                                 const std::function<void(const TrajectoryPoint&)>& visit) const;

  std::unique_ptr<std::FILE, CloseFile> file_;
  std::vector<Block> blocks_;
  std::uint32_t records_ = 0;
  bool failed_ = false;
};

/// As PrunedScans::for_each_scan(); without one, of what the backend has.
[[nodiscard]] Status for_each_scan(const Backend& backend, const PrunedScans* pruned,
                                   const std::function<void(const TrajectoryPoint&)>& visit);

}  // namespace swiftlet
