// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "tools/calibration/calibration_report.hpp"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "core/geometry/angle.hpp"

namespace swiftlet {
namespace {

using Json = nlohmann::ordered_json;
using Verdict = CalibrationFinding::Verdict;

/// Radians are for files; people read degrees.
struct Shown {
  double factor = 1.0;
  std::string unit;
};
Shown shown_in(const CalibrationFinding& finding) {
  if (finding.unit.starts_with("rad")) return {degrees(1.0), fmt::format("deg{}", finding.unit.substr(3))};
  return {1.0, finding.unit};
}

std::string verdict_text(Verdict verdict) {
  switch (verdict) {
    case Verdict::kNotObservable:
      return "not observable";
    case Verdict::kAsIs:
      return "agrees with what is set";
    case Verdict::kNegligible:
      return "differs too little to matter";
    case Verdict::kLearnt:
      return "differs, but every run learns it anew";
    case Verdict::kMatters:
      return "MATTERS";
  }
  return "";
}

std::string row(const CalibrationFinding& finding) {
  const Shown shown = shown_in(finding);
  const std::string name = finding.meaning + (shown.unit.empty() ? "" : ", " + shown.unit);
  if (finding.verdict == Verdict::kNotObservable)
    return fmt::format("  {:<42}{:>9.4f}   not observable: {}\n", name, shown.factor * finding.present,
                       finding.reason);
  return fmt::format("  {:<42}{:>9.4f}{:>11.4f} +- {:<9.4f}{}\n", name, shown.factor * finding.present,
                     shown.factor * finding.value, shown.factor * finding.sigma,
                     verdict_text(finding.verdict));
}

const char* json_name(Verdict verdict) {
  switch (verdict) {
    case Verdict::kNotObservable:
      return "not_observable";
    case Verdict::kAsIs:
      return "as_is";
    case Verdict::kNegligible:
      return "negligible";
    case Verdict::kLearnt:
      return "learnt";
    case Verdict::kMatters:
      return "matters";
  }
  return "";
}

Json json_of(const CalibrationFinding& finding) {
  Json json{{"setting", "sensor." + finding.setting},
            {"unit", finding.unit},
            {"present", finding.present},
            {"verdict", json_name(finding.verdict)}};
  if (finding.verdict == Verdict::kNotObservable) {
    json["reason"] = finding.reason;
  } else {
    json["value"] = finding.value;
    json["sigma"] = finding.sigma;
  }
  return json;
}

std::string setting_line(const CalibrationFinding& finding, bool is_harmful) {
  if (finding.verdict == Verdict::kNotObservable)
    return fmt::format("# {}: not observable: {}\n", finding.setting, finding.reason);
  const std::string assignment = fmt::format("{} = {:.6f}", finding.setting, finding.value);
  const std::string known = fmt::format("+- {:.6f}, was {:.6g}", finding.sigma, finding.present);
  if (finding.verdict == Verdict::kMatters && is_harmful)
    return fmt::format("# {}  {}: the map gets worse with it\n", assignment, known);
  if (finding.verdict == Verdict::kMatters) return fmt::format("{}  # {}\n", assignment, known);
  return fmt::format("# {}  {}: {}\n", assignment, known, verdict_text(finding.verdict));
}

/// On one line, whatever the name holds.
std::string one_line(std::string text) {
  std::replace_if(
      text.begin(), text.end(), [](unsigned char c) { return c < 0x20 || c == 0x7f; }, ' ');
  return text;
}

}  // namespace

std::string calibration_text(const CalibrationReport& report) {
  const MotionSummary& motion = report.motion;
  std::string text =
      fmt::format("{}: {} samples in {:.0f} s; {:.0f} m forward and back, {:.0f} m sideways, {:.1f} turns\n",
                  report.input_uri, report.samples, motion.duration_s, motion.forward_m, motion.sideways_m,
                  motion.turned_rad / (2.0 * kPi));
  text += fmt::format("  {:<42}{:>9}{:>11}    {:<9}{}\n", "", "set now", "found", "sigma", "difference");
  for (const CalibrationFinding& finding : report.findings) text += row(finding);
  if (report.check)
    text += fmt::format("  held-out returns lie {:.1f} mm off the walls, with what matters set {:.1f} mm\n",
                        1e3 * report.check->held_out_before_m, 1e3 * report.check->held_out_after_m);
  if (report.check && report.check->is_worse())
    text += "  worse than before: nothing is set; look at the maps of both before you use these figures\n";
  return text;
}

std::string calibration_json(const CalibrationReport& report) {
  Json json{{"input", report.input_uri},
            {"samples", report.samples},
            {"duration_s", report.motion.duration_s},
            {"forward_m", report.motion.forward_m},
            {"sideways_m", report.motion.sideways_m},
            {"turned_rad", report.motion.turned_rad},
            {"findings", Json::array()}};
  for (const CalibrationFinding& finding : report.findings) json["findings"].push_back(json_of(finding));
  json["check"] = nullptr;
  if (report.check)
    json["check"] = {{"held_out_before_m", report.check->held_out_before_m},
                     {"held_out_after_m", report.check->held_out_after_m},
                     {"is_worse", report.check->is_worse()}};
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string calibration_toml(const CalibrationReport& report) {
  std::string text =
      fmt::format("# Found by: swiftlet calibrate {}\n# in {} samples over {:.0f} s.\n\n[sensor]\n",
                  one_line(report.input_uri), report.samples, report.motion.duration_s);
  const bool is_harmful = report.check && report.check->is_worse();
  for (const CalibrationFinding& finding : report.findings) text += setting_line(finding, is_harmful);
  return text;
}

}  // namespace swiftlet
