// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "daemon/outputs/run_outputs.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "core/geometry/stamped_pose.hpp"
#include "core/mapping/picture/map_raster.hpp"
#include "core/mapping/picture/thumbnail.hpp"
#include "daemon/outputs/file_writer.hpp"
#include "daemon/outputs/places_file.hpp"
#include "daemon/outputs/png_file.hpp"
#include "daemon/outputs/report_file.hpp"
#include "daemon/outputs/ros_map.hpp"
#include "daemon/outputs/run_report.hpp"
#include "daemon/outputs/tum_trajectory.hpp"

namespace swiftlet {

namespace {

constexpr const char* kTruth = "ground_truth.tum";
constexpr const char* kPlaces = "places.csv";
constexpr const char* kReport = "report.json";
constexpr int kThumbnailPx = 256;

Status write_picture(const std::filesystem::path& path, const RgbImage& picture) {
  const Result<std::string> png = encode_png(picture);
  if (!png) return png.error();
  return write_file(path, *png);
}

/// "map.png" of the first storey, "map_storey1.png" of the next.
std::string name_on(StoreyId storey, const std::string& stem, const std::string& extension) {
  return stem + (storey == StoreyId{} ? "" : "_storey" + std::to_string(index_of(storey))) + extension;
}

Status write_pictures(const std::filesystem::path& directory, const RunView& run) {
  for (const StoreyId storey : run.map.storeys()) {
    MapScene scene = make_map_scene(run.backend, run.map, storey);
    scene.title = std::filesystem::path(run.input_uri).filename().string();
    if (storey != StoreyId{}) scene.title += ", storey " + std::to_string(index_of(storey));
    Status written;
    if (run.has_plan) written = write_picture(directory / name_on(storey, "plan", ".png"), draw_plan(scene));
    if (!written) return written;
    const RgbImage picture = draw_map(scene);
    written = write_picture(directory / name_on(storey, "map", ".png"), picture);
    if (written && storey == StoreyId{})
      written = write_picture(directory / "thumbnail.png", thumbnail_of(picture, kThumbnailPx));
    if (!written) return written;
  }
  return {};
}

/// Of laser logs they may step back.
bool stamps_ascend(const RunView& run) {
  HostTime last = HostTime::min();
  bool ascend = true;
  const Status visited = for_each_scan(
      run, [&](const TrajectoryPoint& at) { ascend = ascend && std::exchange(last, at.stamp) <= at.stamp; });
  return ascend && visited.ok();
}

/// In the order of their stamps. Where these ascend, a line at a time: hours of a patrol need not fit into
/// memory.
Status write_trajectory(const std::filesystem::path& path, const RunView& run, Pose2 TrajectoryPoint::*pose,
                        bool ascend) {
  return write_file(path, [&](const FileSink& write) {
    std::string line;
    const auto write_pose = [&](const StampedPose& at) {
      line.clear();
      append_tum_line(line, at.stamp, at.pose);
      write(line);
    };
    if (ascend)
      return for_each_scan(run, [&](const TrajectoryPoint& at) { write_pose({at.stamp, at.*pose}); });
    std::vector<StampedPose> poses;
    Status visited = for_each_scan(run, [&](const TrajectoryPoint& at) {
      poses.push_back({at.stamp, at.*pose});
    });
    std::ranges::stable_sort(poses, {}, &StampedPose::stamp);
    for (const StampedPose& at : poses) write_pose(at);
    return visited;
  });
}

Status write_trajectories(const std::filesystem::path& directory, const RunView& run) {
  const bool ascend = stamps_ascend(run);
  Status written = write_trajectory(directory / "trajectory.tum", run, &TrajectoryPoint::T_map_body, ascend);
  if (written)
    written = write_trajectory(directory / "odometry.tum", run, &TrajectoryPoint::T_odom_body, ascend);
  if (written) written = write_trajectory(directory / "live.tum", run, &TrajectoryPoint::T_map_live, ascend);
  if (!written || run.truth.empty()) return written;
  return write_file(directory / kTruth, [&](const FileSink& write) {
    std::string line;
    for (const StampedPose& at : run.truth) {
      line.clear();
      append_tum_line(line, at.stamp, at.pose);
      write(line);
    }
    return Status();
  });
}

Status write_places(const std::filesystem::path& directory, const RunView& run) {
  if (run.places.empty()) return {};
  const Result<std::string> text = places_csv(run);
  if (!text) return text.error();
  return write_file(directory / kPlaces, *text);
}

/// Those that its report lists; of a report that lists none, itself. Nothing else is taken for a run's.
std::vector<std::string> files_of_earlier_run(const std::filesystem::path& directory) {
  const Result<nlohmann::ordered_json> report = read_report(directory / kReport);
  if (!report) return {};
  std::vector<std::string> files{kReport};
  if (!report->is_object() || !report->contains("files")) return files;
  for (const nlohmann::ordered_json& entry : (*report)["files"]) {
    const std::string name = entry.is_string() ? entry.get<std::string>() : "";
    if (std::filesystem::path(name).filename() == name) files.push_back(name);
  }
  return files;
}

}  // namespace

Status write_map_files(const std::filesystem::path& directory, const MapBuilder& map) {
  for (const StoreyId storey : map.storeys()) {
    const std::vector<TileIndex> tiles = map.tiles(storey);
    const std::string pgm = name_on(storey, "map", ".pgm");
    Status written = write_file(directory / pgm, [&](const FileSink& write) {
      write_pgm(
          tiles, [&map](TileIndex index) { return map.tile(index); }, write);
      return Status();
    });
    if (written)
      written = write_file(directory / name_on(storey, "map", ".yaml"),
                           ros_map_yaml(tiles, map.config().resolution_m, pgm));
    if (!written) return written;
  }
  return {};
}

Status for_each_scan(const RunView& run, const std::function<void(const TrajectoryPoint&)>& visit) {
  return for_each_scan(run.backend, run.pruned, [&](TrajectoryPoint at) {
    at.T_odom_body = as_reported(run.mended, at.stamp, at.T_odom_body);
    visit(at);
  });
}

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

std::vector<std::string> output_names(const RunView& run) {
  std::vector<std::string> names{"trajectory.tum", "odometry.tum", "live.tum"};
  if (!run.truth.empty()) names.emplace_back(kTruth);
  if (!run.places.empty()) names.emplace_back(kPlaces);
  for (const StoreyId storey : run.map.storeys()) {
    if (run.has_plan) names.push_back(name_on(storey, "plan", ".png"));
    for (const char* const extension : {".pgm", ".yaml", ".png"})
      names.push_back(name_on(storey, "map", extension));
  }
  names.insert(names.end(), {"thumbnail.png", kReport});
  return names;
}

namespace {

/// One that cannot be written does not keep the others from it. Error: the first one's.
Status write_all_but_report(const std::filesystem::path& directory, const RunView& run) {
  Status first = write_trajectories(directory, run);
  const auto keep_first = [&first](Status next) {
    if (first) first = std::move(next);
  };
  keep_first(write_places(directory, run));
  keep_first(write_map_files(directory, run.map));
  keep_first(write_pictures(directory, run));
  return first;
}

}  // namespace

Result<WrittenOutputs> write_run_outputs(const std::filesystem::path& directory, const RunView& run) {
  if (Status ready = prepare_output_directory(directory); !ready) return ready.error();
  const std::vector<std::string> earlier = files_of_earlier_run(directory);
  std::error_code failure;
  std::filesystem::remove(directory / kReport, failure);  // no longer that of what lies beside it
  if (Status written = write_all_but_report(directory, run); !written) return written.error();
  WrittenOutputs outputs{.files = output_names(run), .replaced = !earlier.empty(), .removed = {}};
  for (const std::string& name : earlier) {
    if (std::ranges::find(outputs.files, name) == outputs.files.end() &&
        std::filesystem::remove(directory / name, failure))
      outputs.removed.push_back(name);
  }
  if (Status written = write_file(directory / kReport, run_report_json(run)); !written)
    return written.error();
  return outputs;
}

std::optional<std::string> replacement_note(const std::filesystem::path& directory,
                                            const WrittenOutputs& outputs) {
  if (!outputs.replaced) return std::nullopt;
  std::string note = directory.string() + " held an earlier run: its files were replaced";
  for (std::size_t i = 0; i < outputs.removed.size(); ++i)
    note += (i == 0 ? ", removed those that this run does not have: " : " ") + outputs.removed[i];
  return note;
}

}  // namespace swiftlet
