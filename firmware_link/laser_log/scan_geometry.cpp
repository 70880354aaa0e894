// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "firmware_link/laser_log/scan_geometry.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/base/check.hpp"
#include "core/geometry/angle.hpp"

namespace swiftlet {
namespace {

struct Scanner {
  std::size_t readings;
  double start_deg;
  double step_deg;
};
constexpr std::array<Scanner, 10> kScanners{{{180, -90.0, 1.0},
                                             {181, -90.0, 1.0},
                                             {360, -90.0, 0.5},
                                             {361, -90.0, 0.5},
                                             {400, -50.0, 0.25},
                                             {401, -50.0, 0.25},
                                             {541, -135.0, 0.5},
                                             {682, -119.7, 360.0 / 1024.0},
                                             {683, -119.9, 360.0 / 1024.0},
                                             {1081, -135.0, 0.25}}};

constexpr double kNearSteps = 0.5 + 1e-6;  // but for rounding

}  // namespace

std::optional<ScanGeometry> usual_geometry(std::size_t readings) {
  for (const Scanner& scanner : kScanners)
    if (scanner.readings == readings)
      return ScanGeometry{readings, radians(scanner.start_deg), radians(scanner.step_deg)};
  return std::nullopt;
}

std::vector<std::size_t> pick_beams(std::size_t readings, std::size_t beam_count) {
  SWIFTLET_CHECK(beam_count >= 2 && beam_count <= readings,
                 "beams are picked from at least as many readings");
  const std::size_t gaps = beam_count - 1;
  const std::size_t stride = readings / gaps;
  const std::size_t last = readings - 1;
  const bool leaves_a_sector = 2 * (last - (gaps - 1) * stride) > 3 * stride;
  std::vector<std::size_t> picked;
  for (std::size_t i = 0; i < gaps; ++i)
    picked.push_back(leaves_a_sector ? (2 * i * last + gaps) / (2 * gaps) : i * stride);
  picked.push_back(last);
  return picked;
}

std::vector<std::size_t> readings_along(const BeamLayout& beams, const ScanGeometry& geometry) {
  const double last = static_cast<double>(geometry.readings - 1);
  const double middle_rad = geometry.start_rad + 0.5 * last * geometry.step_rad;
  std::vector<std::size_t> along;
  for (std::size_t i = 0; i < beams.count; ++i) {
    // Bearings wrap: a scan reaches at most half a turn to either side of its middle.
    const double steps = 0.5 * last + wrap_angle(beams.bearing_rad[i] - middle_rad) / geometry.step_rad;
    const double nearest = std::clamp(std::round(steps), 0.0, last);
    along.push_back(std::abs(steps - nearest) <= kNearSteps ? static_cast<std::size_t>(nearest) : kNoReading);
  }
  return along;
}

}  // namespace swiftlet
