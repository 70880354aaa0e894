// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "daemon/outputs/run_outputs.hpp"

#include <functional>
#include <utility>

#include "core/mapping/map_raster.hpp"
#include "daemon/outputs/file_writer.hpp"
#include "daemon/outputs/png_file.hpp"
#include "daemon/outputs/ros_map.hpp"
#include "daemon/outputs/run_report.hpp"
#include "daemon/outputs/tum_trajectory.hpp"

namespace swiftlet {

namespace {

std::string trajectory_text(const ScanStore& scans, const std::function<Pose2(ScanIndex)>& pose_of) {
  std::string text;
  for (ScanIndex i = 0; i < scans.size(); ++i) append_tum_line(text, scans[i].stamp, pose_of(i));
  return text;
}

Status write_map_files(const std::filesystem::path& directory, const MapBuilder& map) {
  std::vector<MapTile> tiles;
  for (const TileIndex index : map.tiles()) tiles.push_back(map.tile(index));
  const double resolution_m = map.config().resolution_m;
  const RosMap ros_map = make_ros_map(tiles, resolution_m);
  if (Status written = write_file(directory / "map.pgm", pgm_text(ros_map)); !written) return written;
  return write_file(directory / "map.yaml", ros_map_yaml(ros_map, resolution_m, "map.pgm"));
}

Status write_picture(const std::filesystem::path& directory, const RunView& run) {
  const Result<std::string> png = encode_png(draw_map(make_map_scene(run.backend, run.map)));
  if (!png) return png.error();
  return write_file(directory / "map.png", *png);
}

Status write_trajectories(const std::filesystem::path& directory, const RunView& run) {
  const ScanStore& scans = run.backend.scans();
  const std::string corrected =
      trajectory_text(scans, [&](ScanIndex i) { return run.backend.T_map_body(i); });
  if (Status written = write_file(directory / "trajectory.tum", corrected); !written) return written;
  const std::string odometry = trajectory_text(scans, [&](ScanIndex i) { return scans[i].T_odom_body; });
  if (Status written = write_file(directory / "odometry.tum", odometry); !written) return written;
  const std::string live = trajectory_text(scans, [&](ScanIndex i) { return scans[i].T_map_live; });
  if (Status written = write_file(directory / "live.tum", live); !written) return written;
  if (run.truth.empty()) return {};
  std::string truth;
  for (const StampedPose& at : run.truth) append_tum_line(truth, at.stamp, at.pose);
  return write_file(directory / "ground_truth.tum", truth);
}

}  // namespace

std::optional<RunError> run_error(const Backend& backend, const std::vector<StampedPose>& truth) {
  const ScanStore& scans = backend.scans();
  std::vector<Point2> odometry;
  std::vector<Point2> live;
  std::vector<Point2> corrected;
  std::vector<Point2> known;
  auto at = truth.begin();
  for (ScanIndex i = 0; i < scans.size(); ++i) {
    while (at != truth.end() && at->stamp < scans[i].stamp) ++at;
    if (at == truth.end()) break;
    if (at->stamp != scans[i].stamp) continue;
    odometry.push_back(scans[i].T_odom_body.position());
    live.push_back(scans[i].T_map_live.position());
    corrected.push_back(backend.T_map_body(i).position());
    known.push_back(at->pose.position());
  }
  if (known.empty()) return std::nullopt;
  return RunError{trajectory_error(odometry, known), trajectory_error(live, known),
                  trajectory_error(corrected, known)};
}

Status write_run_outputs(const std::filesystem::path& directory, const RunView& run) {
  if (Status ready = prepare_output_directory(directory); !ready) return ready;
  if (Status written = write_trajectories(directory, run); !written) return written;
  if (Status written = write_map_files(directory, run.map); !written) return written;
  if (Status written = write_picture(directory, run); !written) return written;
  return write_file(directory / "report.json", run_report_json(run));
}

}  // namespace swiftlet
