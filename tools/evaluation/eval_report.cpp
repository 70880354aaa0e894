// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "tools/evaluation/eval_report.hpp"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <chrono>
#include <nlohmann/json.hpp>
#include <optional>
#include <vector>

namespace swiftlet {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t kNamedStamps = 3;

/// Stamps are exact to the microsecond: so they come out with no digits of the binary number.
double rounded_seconds_of(HostTime stamp) {
  const auto us = std::chrono::round<std::chrono::microseconds>(stamp.time_since_epoch());
  return static_cast<double>(us.count()) / 1e6;
}

std::size_t relations_in(const RelationError& error) { return error.all.count + error.missed; }

/// "1.000000 2.000000 3.000000 and 7 more".
std::string named(const std::vector<HostTime>& stamps) {
  std::string text;
  for (std::size_t i = 0; i < std::min(stamps.size(), kNamedStamps); ++i)
    text += fmt::format("{}{:.6f}", i == 0 ? "" : " ", rounded_seconds_of(stamps[i]));
  if (stamps.size() > kNamedStamps) text += fmt::format(" and {} more", stamps.size() - kNamedStamps);
  return text;
}

std::string stamps_line(const StampMatching& stamps, const char* whose) {
  std::string text =
      fmt::format("  stamps: {} exact, {} within 2 ms, {}{} unmatched\n", stamps.exact, stamps.near,
                  stamps.between > 0 ? fmt::format("{} interpolated or within 20 ms, ", stamps.between) : "",
                  stamps.unmatched.size());
  if (!stamps.unmatched.empty()) text += fmt::format("  {}: {}\n", whose, named(stamps.unmatched));
  return text;
}

std::string motion_line(const char* name, const MotionError& error) {
  if (error.count == 0) return fmt::format("  {:<12}{:>7}\n", name, 0);
  const Spread& m = error.translation_m;
  const Spread& deg = error.rotation_deg;
  return fmt::format("  {:<12}{:>7}   {:9.4f}{:9.4f}{:9.4f}   {:9.3f}{:9.3f}{:9.3f}\n", name, error.count,
                     m.mean, m.deviation, m.max, deg.mean, deg.deviation, deg.max);
}

std::string text_of(const std::string& file, const RelationError& error) {
  std::string text = fmt::format("{}: {} of {} relations\n", file, error.all.count, relations_in(error));
  text += fmt::format("  {:<12}{:>7}   {:>27}   {:>27}\n", "", "", "translation, m", "rotation, deg");
  text += fmt::format("  {:<12}{:>7}   {:>9}{:>9}{:>9}   {:>9}{:>9}{:>9}\n", "time spanned", "count", "mean",
                      "std", "max", "mean", "std", "max");
  text += motion_line("all", error.all);
  text += motion_line("under 3 s", error.under_3_s);
  text += motion_line("3 to 100 s", error.from_3_to_100_s);
  text += motion_line("over 100 s", error.over_100_s);
  return text + stamps_line(error.stamps, "not in the trajectory");
}

std::string text_of(const std::string& file, const PathError& error) {
  const std::size_t poses = error.position.pairs + error.stamps.unmatched.size();
  return fmt::format("{}: {} of {} positions, after rigid alignment\n", file, error.position.pairs, poses) +
         fmt::format("  absolute trajectory error, m: rmse {:.4f}, mean {:.4f}, max {:.4f}\n",
                     error.position.rmse_m, error.position.mean_m, error.position.max_m) +
         stamps_line(error.stamps, "not in the truth");
}

std::string text_of(const std::string& file, const FlightResult& flight) {
  const FlightSharpness& sharpness = flight.sharpness;
  std::string text = fmt::format("{}: {} of {} samples drawn along the trajectory\n", file, sharpness.drawn,
                                 sharpness.drawn + sharpness.outside.size());
  text += fmt::format("  returns of 0.05 to 2 m: {}, in {} cells of 0.1 m, {} cells of 0.2 m\n",
                      sharpness.map.returns, sharpness.map.cells_10_cm, sharpness.map.cells_20_cm);
  if (sharpness.interpolated > 0)
    text += fmt::format("  samples without a pose within 2 ms, drawn between poses: {}\n",
                        sharpness.interpolated);
  if (!sharpness.outside.empty())
    text += fmt::format("  samples outside the trajectory's time: {}, at {}\n", sharpness.outside.size(),
                        named(sharpness.outside));
  if (flight.input.counters.unpaired > 0)
    text += fmt::format("  range packets without dead reckoning, not drawn: {}\n",
                        flight.input.counters.unpaired);
  return text;
}

/// How much of what a reference holds, or of the trajectory, could be compared.
struct Compared {
  std::size_t count = 0;
  std::size_t of = 0;
  const char* what = "";
};
Compared compared(const RelationError& error) { return {error.all.count, relations_in(error), "relations"}; }
Compared compared(const PathError& error) {
  return {error.position.pairs, error.position.pairs + error.stamps.unmatched.size(), "positions"};
}
Compared compared(const FlightResult& flight) {
  return {flight.sharpness.drawn, flight.sharpness.drawn + flight.sharpness.outside.size(), "samples"};
}

/// A line where most of it could not.
std::string warning_of(const ReferenceResult& reference) {
  const Compared pairs = std::visit([](const auto& figures) { return compared(figures); }, reference.figures);
  if (2 * pairs.count >= pairs.of) return {};
  return fmt::format("WARNING: {}: only {} of {} {} have stamps that match; the figures are of those alone\n",
                     reference.file, pairs.count, pairs.of, pairs.what);
}

Json json_of(const std::vector<HostTime>& stamps) {
  Json json = Json::array();
  for (const HostTime stamp : stamps) json.push_back(rounded_seconds_of(stamp));
  return json;
}

Json json_of(const StampMatching& stamps) {
  return {{"exact", stamps.exact},
          {"within_2_ms", stamps.near},
          {"between", stamps.between},
          {"unmatched", stamps.unmatched.size()},
          {"unmatched_s", json_of(stamps.unmatched)}};
}

Json json_of(const Spread& spread) {
  return {{"mean", spread.mean}, {"std", spread.deviation}, {"max", spread.max}};
}

Json json_of(const MotionError& error) {
  Json json{{"count", error.count}};
  json["translation_m"] = error.count > 0 ? json_of(error.translation_m) : Json(nullptr);
  json["rotation_deg"] = error.count > 0 ? json_of(error.rotation_deg) : Json(nullptr);
  return json;
}

Json json_of(const std::vector<std::optional<double>>& values) {
  Json json = Json::array();
  for (const std::optional<double>& value : values) json.push_back(value ? Json(*value) : Json(nullptr));
  return json;
}

Json json_of(const RelationError& error) {
  return {{"kind", "relations"},
          {"relations", relations_in(error)},
          {"missed", error.missed},
          {"all", json_of(error.all)},
          {"under_3_s", json_of(error.under_3_s)},
          {"from_3_to_100_s", json_of(error.from_3_to_100_s)},
          {"over_100_s", json_of(error.over_100_s)},
          {"each_translation_m", json_of(error.each_translation_m)},
          {"stamps", json_of(error.stamps)}};
}

Json json_of(const PathError& error) {
  const Pose2& T = error.position.T_truth_estimate;
  return {{"kind", "truth"},
          {"pairs", error.position.pairs},
          {"rmse_m", error.position.rmse_m},
          {"mean_m", error.position.mean_m},
          {"max_m", error.position.max_m},
          {"T_truth_estimate", {{"x_m", T.x_m()}, {"y_m", T.y_m()}, {"yaw_deg", degrees(T.yaw_rad())}}},
          {"stamps", json_of(error.stamps)}};
}

Json json_of(const FlightResult& flight) {
  const FlightSharpness& sharpness = flight.sharpness;
  return {{"kind", "flight"},
          {"samples", sharpness.drawn + sharpness.outside.size()},
          {"drawn", sharpness.drawn},
          {"interpolated", sharpness.interpolated},
          {"outside", sharpness.outside.size()},
          {"outside_s", json_of(sharpness.outside)},
          {"unpaired", flight.input.counters.unpaired},
          {"returns", sharpness.map.returns},
          {"cells_10_cm", sharpness.map.cells_10_cm},
          {"cells_20_cm", sharpness.map.cells_20_cm},
          {"problems", flight.input.problems}};
}

}  // namespace

std::string evaluation_text(const Evaluation& evaluation) {
  std::string text;
  for (const ReferenceResult& reference : evaluation.references) text += warning_of(reference);
  text += fmt::format("{}: {} poses over {:.1f} s\n", evaluation.trajectory_file, evaluation.poses,
                      to_seconds(evaluation.last_stamp - evaluation.first_stamp));
  for (const ReferenceResult& reference : evaluation.references) {
    const auto print = [&](const auto& figures) { return text_of(reference.file, figures); };
    text += '\n';
    text += std::visit(print, reference.figures);
  }
  return text;
}

std::string evaluation_json(const Evaluation& evaluation) {
  Json json{{"trajectory",
             {{"file", evaluation.trajectory_file},
              {"poses", evaluation.poses},
              {"first_stamp_s", rounded_seconds_of(evaluation.first_stamp)},
              {"last_stamp_s", rounded_seconds_of(evaluation.last_stamp)}}},
            {"references", Json::array()}};
  for (const ReferenceResult& reference : evaluation.references) {
    Json entry{{"file", reference.file}};
    entry.update(std::visit([](const auto& figures) { return json_of(figures); }, reference.figures));
    json["references"].push_back(std::move(entry));
  }
  // Names of files may hold any bytes: what is not UTF-8 is replaced.
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace swiftlet
