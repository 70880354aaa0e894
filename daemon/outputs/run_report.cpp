// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "daemon/outputs/run_report.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "daemon/outputs/consistency_json.hpp"
#include "daemon/outputs/known_place_json.hpp"
#include "daemon/outputs/peak_memory.hpp"

namespace swiftlet {

namespace {

using Json = nlohmann::ordered_json;

Json input_json(const RunView& run) {
  const InputReport& input = run.input;
  const InputCounters& counters = input.counters;
  return {{"uri", run.input_uri},
          {"frames", counters.frames},
          {"samples", counters.samples},
          {"range_packets", counters.range_packets},
          {"odometry_packets", counters.odometry_packets},
          {"duplicates", counters.duplicates},
          {"out_of_order", counters.out_of_order},
          {"gaps", counters.gaps},
          {"missing_packets", counters.missing_packets},
          {"repeated", counters.repeated},
          {"unpaired", counters.unpaired},
          {"segments", counters.segments},
          {"beams",
           {{"hits", counters.hits},
            {"no_returns", counters.no_returns},
            {"invalid", counters.invalid},
            {"floor_returns", counters.floor_returns}}},
          {"reversed_m", input.reversed_m},
          {"notes", input.notes},
          {"problems", input.problems}};
}

Json sensor_json(const RunView& run) {
  const OdometryCalibration& calibration = run.sensor.odometry_calibration;
  return {{"beams", run.backend.scans().beams().count},
          {"min_range_m", run.sensor.min_range_m},
          {"max_range_m", run.sensor.max_range_m},
          {"range_sigma_m", run.sensor.range_sigma_m},
          {"range_age_s", to_seconds(run.sensor.range_age)},
          {"odometry_forward_scale", calibration.forward_scale},
          {"odometry_sideways_scale", calibration.sideways_scale},
          {"missed_yaw_per_metre_rad", calibration.yaw_per_metre_rad},
          {"missed_yaw_per_radian", calibration.yaw_per_radian},
          {"missed_yaw_per_second_rad", calibration.yaw_per_second_rad}};
}

/// What the input showed of its own sensors.
Json calibration_json(const std::optional<InputCalibration>& calibration) {
  if (!calibration) return nullptr;
  Json json = Json::object();
  for (std::size_t k = 0; k < kSystematicErrors; ++k) {
    const auto error = static_cast<SystematicError>(k);
    const double sigma = calibration->sigma(index_of(error));
    if (sigma > 0.0)
      json[setting_of(error)] = {{"expected", value_in(calibration->expected, error)},
                                 {"found", value_in(calibration->found, error)},
                                 {"sigma", sigma}};
  }
  return json;
}

Json frontend_json(const FrontendCounters& frontend) {
  return {{"samples", frontend.samples},
          {"keyframes", frontend.keyframes},
          {"lines_extracted", frontend.lines_extracted},
          {"observations_added", frontend.observations_added},
          {"batches_rolled_back", frontend.batches_rolled_back},
          {"landmarks_created", frontend.landmarks_created},
          {"landmarks_retired", frontend.landmarks_retired},
          {"poses_retired", frontend.poses_retired},
          {"refused_full", frontend.refused_full}};
}

Json backend_json(const Backend& backend) {
  const BackendCounters& counters = backend.counters();
  return {{"scans", counters.scans},
          {"scans_pruned", counters.scans_pruned},
          {"keyframes", counters.keyframes},
          {"submaps", counters.submaps},
          {"walls", backend.walls().size()},
          {"closures",
           {{"tried", counters.candidates_matched},
            {"accepted", counters.closures_accepted},
            {"dropped", counters.closures_dropped}}},
          {"optimizations", counters.optimizations},
          {"windows", {{"refined", counters.windows_refined}, {"refused", counters.windows_refused}}},
          {"stretches", {{"refined", counters.stretches_refined}, {"refused", counters.stretches_refused}}},
          {"map_source", name_of(counters.map_source)},
          {"yaw_noise_factor", counters.yaw_noise_factor},
          {"floor_cost", counters.floor_cost},
          {"refined", counters.refined},
          {"solver_failures", counters.solver_failures}};
}

Json tracking_json(const TrackingFigures& figures) {
  return {{"state", name_of(figures.tracking)},
          {"contradiction", figures.contradiction},
          {"contradicting_share", figures.contradicting_share},
          {"returns_compared", figures.returns_compared},
          {"times_uncertain", figures.times_uncertain},
          {"places_weighed", figures.places_weighed},
          {"place_lead", figures.place_lead},
          {"innovation", figures.innovation},
          {"way_since_agreement_m", figures.way_since_agreement_m},
          {"way_since_closure_m", figures.way_since_closure_m},
          {"way_unplaced_m", figures.way_unplaced_m}};
}

Json trajectory_json(const Backend& backend) {
  const std::span<const StoredScan> scans = backend.scans().all().values();
  if (scans.empty()) return {{"duration_s", 0.0}, {"odometry_length_m", 0.0}};
  return {{"duration_s", to_seconds(scans.back().stamp - scans.front().stamp)},
          {"odometry_length_m", scans.back().path_m}};
}

/// The rectangle around all tiles.
Json map_json(const MapBuilder& map) {
  const std::vector<TileIndex> tiles = map.tiles();
  const double resolution_m = map.config().resolution_m;
  Json json{{"resolution_m", resolution_m}, {"tiles", tiles.size()}};
  if (tiles.empty()) return json;
  const auto by_y = [](TileIndex a, TileIndex b) { return a.y < b.y; };
  const auto [lowest, highest] = std::minmax_element(tiles.begin(), tiles.end(), by_y);
  const double tile_m = kTileCells * resolution_m;
  json["extent_m"] = {{"x", {tiles.front().x * tile_m, (tiles.back().x + 1) * tile_m}},
                      {"y", {lowest->y * tile_m, (highest->y + 1) * tile_m}}};
  return json;
}

/// By storey; null where the input does not show how high it lies.
Json storeys_json(const RunView& run) {
  const std::vector<double>& levels_m = run.input.storey_levels_m;
  Json json = Json::array();
  for (const StoreyId storey : run.map.storeys()) {
    const std::size_t i = index_of(storey);
    json.push_back({{"storey", i},
                    {"level_m", i < levels_m.size() ? Json(levels_m[i]) : Json(nullptr)},
                    {"tiles", run.map.tiles(storey).size()}});
  }
  return json;
}

Json times_json(const std::vector<StageSummary>& times) {
  Json json = Json::object();
  for (const StageSummary& stage : times)
    json[stage.name] = {{"count", stage.count},   {"mean_ms", stage.mean_ms}, {"p50_ms", stage.p50_ms},
                        {"p99_ms", stage.p99_ms}, {"p999_ms", stage.p999_ms}, {"max_ms", stage.max_ms}};
  return json;
}

Json queues_json(const std::vector<QueueStatistics>& queues) {
  Json json = Json::object();
  for (const QueueStatistics& queue : queues)
    json[queue.name] = {
        {"capacity", queue.capacity}, {"high_water", queue.high_water}, {"refused", queue.refused}};
  return json;
}

/// Into the object that ends `text`, a line a stage: people read reports, too.
void append_histograms(const std::vector<StageBuckets>& stages, std::string& text) {
  text.erase(text.rfind('}'));
  text.erase(text.find_last_not_of('\n') + 1);
  text += ",\n  \"histograms_ns\": {";
  const char* separator = "\n";
  for (const StageBuckets& stage : stages) {
    Json buckets = Json::array();
    for (const auto& [upper_ns, count] : stage.buckets) buckets.push_back({upper_ns, count});
    text += separator + ("    \"" + stage.name + "\": ") + buckets.dump();
    separator = ",\n";
  }
  text += "\n  }\n}";
}

Json error_json(const TrajectoryError& error) {
  return {{"rmse_m", error.rmse_m}, {"mean_m", error.mean_m}, {"max_m", error.max_m}};
}

}  // namespace

std::string run_report_json(const RunView& run) {
  Json json{{"files", output_names(run)},
            {"input", input_json(run)},
            {"sensor", sensor_json(run)},
            {"calibration", calibration_json(run.calibration)},
            {"frontend", frontend_json(run.frontend)},
            {"backend", backend_json(run.backend)},
            {"tracking", tracking_json(run.backend.tracking())},
            {"trajectory", trajectory_json(run.backend)},
            {"map", map_json(run.map)},
            {"storeys", storeys_json(run)}};
  if (const auto error = run_error(run))
    json["absolute_trajectory_error"] = {{"samples", error->corrected.pairs},
                                         {"odometry", error_json(error->odometry)},
                                         {"live", error_json(error->live)},
                                         {"corrected", error_json(error->corrected)}};
  if (run.known_places) json["known_place_error"] = known_place_json(*run.known_places);
  if (run.consistency) json["consistency"] = consistency_json(*run.consistency);
  json["stage_times"] = times_json(run.timing.stages);
  if (!run.timing.queues.empty()) {
    json["queues"] = queues_json(run.timing.queues);
    json["pose_deadline"] = {{"ms", to_seconds(run.timing.pose_deadline) * 1e3},
                             {"missed", run.timing.missed_deadlines}};
  }
  json["run_peak_memory_mb"] = run.peak_memory_mb;
  json["peak_memory_mb"] = peak_memory_mb();  // with the picture
  // Names of files may hold any bytes: what is not UTF-8 is replaced, not a reason to lose the report.
  std::string text = json.dump(2, ' ', false, Json::error_handler_t::replace);
  append_histograms(run.timing.buckets, text);
  return text + "\n";
}

}  // namespace swiftlet
