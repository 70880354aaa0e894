// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "daemon/outputs/run_outputs.hpp"

#include <functional>
#include <utility>

#include "core/mapping/picture/map_raster.hpp"
#include "daemon/outputs/file_writer.hpp"
#include "daemon/outputs/png_file.hpp"
#include "daemon/outputs/ros_map.hpp"
#include "daemon/outputs/run_report.hpp"
#include "daemon/outputs/tum_trajectory.hpp"

namespace swiftlet {

namespace {

Status write_map_files(const std::filesystem::path& directory, const MapBuilder& map) {
  const std::vector<TileIndex> tiles = map.tiles();
  Status written = write_file(directory / "map.pgm", [&](const FileSink& write) {
    write_pgm(
        tiles, [&map](TileIndex index) { return map.tile(index); }, write);
    return Status();
  });
  if (!written) return written;
  return write_file(directory / "map.yaml", ros_map_yaml(tiles, map.config().resolution_m, "map.pgm"));
}

Status write_picture(const std::filesystem::path& directory, const RunView& run) {
  const Result<std::string> png = encode_png(draw_map(make_map_scene(run.backend, run.map)));
  if (!png) return png.error();
  return write_file(directory / "map.png", *png);
}

Status for_each_scan(const RunView& run, const std::function<void(const TrajectoryPoint&)>& visit) {
  return for_each_scan(run.backend, run.pruned, [&](TrajectoryPoint at) {
    at.T_odom_body = as_reported(run.mended, at.stamp, at.T_odom_body);
    visit(at);
  });
}

/// A line at a time: hours of a patrol need not fit into memory.
Status write_trajectory(const std::filesystem::path& path, const RunView& run, Pose2 TrajectoryPoint::*pose) {
  return write_file(path, [&](const FileSink& write) {
    std::string line;
    return for_each_scan(run, [&](const TrajectoryPoint& at) {
      line.clear();
      append_tum_line(line, at.stamp, at.*pose);
      write(line);
    });
  });
}

Status write_trajectories(const std::filesystem::path& directory, const RunView& run) {
  Status written = write_trajectory(directory / "trajectory.tum", run, &TrajectoryPoint::T_map_body);
  if (written) written = write_trajectory(directory / "odometry.tum", run, &TrajectoryPoint::T_odom_body);
  if (written) written = write_trajectory(directory / "live.tum", run, &TrajectoryPoint::T_map_live);
  if (!written || run.truth.empty()) return written;
  return write_file(directory / "ground_truth.tum", [&](const FileSink& write) {
    std::string line;
    for (const StampedPose& at : run.truth) {
      line.clear();
      append_tum_line(line, at.stamp, at.pose);
      write(line);
    }
    return Status();
  });
}

}  // namespace

std::optional<RunError> run_error(const RunView& run) {
  std::vector<Point2> odometry;
  std::vector<Point2> live;
  std::vector<Point2> corrected;
  std::vector<Point2> known;
  auto truth = run.truth.begin();
  const Status visited = for_each_scan(run, [&](const TrajectoryPoint& at) {
    while (truth != run.truth.end() && truth->stamp < at.stamp) ++truth;
    if (truth == run.truth.end() || truth->stamp != at.stamp) return;
    odometry.push_back(at.T_odom_body.position());
    live.push_back(at.T_map_live.position());
    corrected.push_back(at.T_map_body.position());
    known.push_back(truth->pose.position());
  });
  if (!visited || known.empty()) return std::nullopt;
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
