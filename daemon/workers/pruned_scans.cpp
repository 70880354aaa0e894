// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "daemon/workers/pruned_scans.hpp"

#include <algorithm>
#include <cerrno>
#include <system_error>

namespace swiftlet {
namespace {

struct StoredPose {
  double x_m;
  double y_m;
  double yaw_rad;
};

/// As it lies in the file, which this machine alone reads.
struct Record {
  std::int64_t stamp_ns;
  KeyframeId anchor;
  StoreyId storey;
  StoredPose T_anchor_body;
  StoredPose T_odom_body;
  StoredPose T_map_live;
};

StoredPose stored(const Pose2& T) { return {T.x_m(), T.y_m(), T.yaw_rad()}; }
Pose2 pose(const StoredPose& s) { return {s.x_m, s.y_m, s.yaw_rad}; }

TrajectoryPoint point_of(const Backend& backend, ScanId id) {
  const StoredScan& scan = backend.scans()[id];
  return {scan.stamp, backend.T_map_body(id), scan.T_odom_body, scan.T_map_live, scan.storey};
}

}  // namespace

Result<PrunedScans> PrunedScans::open(const std::filesystem::path& directory) {
  const std::filesystem::path path = directory / ".pruned_scans";
  std::FILE* file = std::fopen(path.c_str(), "w+b");
  if (file == nullptr) {
    const std::error_code failure(errno, std::generic_category());
    return Error{ErrorCode::kInvalidInput, path.string() + " cannot be written: " + failure.message() +
                                               "; name another output directory"};
  }
  std::error_code ignored;
  std::filesystem::remove(path, ignored);
  return PrunedScans(file);
}

void PrunedScans::take(const Backend& backend, const Pruning& pruning) {
  const IdMap<ScanId, StoredScan>& scans = backend.scans().all();
  for (const PrunedTraversal& traversal : pruning.traversals) {
    const ScanId first = traversal.scans.first;
    const bool goes_on = !blocks_.empty() && blocks_.back().first + blocks_.back().count == first;
    if (!goes_on) blocks_.push_back({first, 0, records_});
    blocks_.back().count += static_cast<std::uint32_t>(scans.count(traversal.scans));
    const Pose2 T_anchor_map = backend.T_map_keyframe(traversal.anchor).inverse();
    for (ScanId id = first; id < traversal.scans.end; id = scans.next(id))
      write(backend, id, T_anchor_map, traversal.anchor);
  }
}

void PrunedScans::write(const Backend& backend, ScanId scan, const Pose2& T_anchor_map, KeyframeId anchor) {
  const StoredScan& from = backend.scans()[scan];
  const Record record{.stamp_ns = from.stamp.time_since_epoch().count(),
                      .anchor = anchor,
                      .storey = from.storey,
                      .T_anchor_body = stored(T_anchor_map * backend.T_map_body(scan)),
                      .T_odom_body = stored(from.T_odom_body),
                      .T_map_live = stored(from.T_map_live)};
  failed_ |= std::fwrite(&record, sizeof record, 1, file_.get()) != 1;
  ++records_;
}

bool PrunedScans::visit_block(const Backend& backend, const Block& block,
                              const std::function<void(const TrajectoryPoint&)>& visit) const {
  if (::fseeko(file_.get(), static_cast<off_t>(block.first_record * std::uint64_t{sizeof(Record)}),
               SEEK_SET) != 0)
    return false;
  for (std::uint32_t i = 0; i < block.count; ++i) {
    Record record{};
    if (std::fread(&record, sizeof record, 1, file_.get()) != 1) return false;
    visit({HostTime(HostTime::duration(record.stamp_ns)),
           backend.T_map_keyframe(record.anchor) * pose(record.T_anchor_body), pose(record.T_odom_body),
           pose(record.T_map_live), record.storey});
  }
  return true;
}

Status PrunedScans::for_each_scan(const Backend& backend,
                                  const std::function<void(const TrajectoryPoint&)>& visit) const {
  const Error lost{ErrorCode::kOutOfSpace,
                   "pruned scans could not be kept on disk, and the trajectories would miss them; make room "
                   "and map the recording"};
  if (failed_ || std::fflush(file_.get()) != 0) return lost;
  std::vector<Block> blocks = blocks_;
  std::sort(blocks.begin(), blocks.end(), [](const Block& a, const Block& b) { return a.first < b.first; });
  auto block = blocks.begin();
  for (const auto& [id, scan] : backend.scans().all()) {
    for (; block != blocks.end() && block->first < id; ++block)
      if (!visit_block(backend, *block, visit)) return lost;
    visit(point_of(backend, id));
  }
  return {};
}

Status for_each_scan(const Backend& backend, const PrunedScans* pruned,
                     const std::function<void(const TrajectoryPoint&)>& visit) {
  if (pruned != nullptr) return pruned->for_each_scan(backend, visit);
  for (const auto& [id, scan] : backend.scans().all()) visit(point_of(backend, id));
  return {};
}

}  // namespace swiftlet
