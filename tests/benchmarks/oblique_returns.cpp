// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
//
// How far short a range sensor reads walls that it meets at an angle, by the angle: of recorded and of
// simulated flights, so that the simulated sensor can be held against the real one. Each input is mapped; of
// each patch of wall the returns that meet it squarely say where it is, and the oblique ones are held against
// them.
//
//   oblique_returns flights/olsson.pcap flights/rice.pcap
//   oblique_returns 'sim://office?seed=1' 'sim://building?seed=2'
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <numeric>
#include <optional>
#include <vector>

#include "core/backend/refinement/wall_patches.hpp"
#include "core/geometry/angle.hpp"
#include "firmware_link/input/open_sample_source.hpp"
#include "tests/support/corrected_run.hpp"

namespace swiftlet {
namespace {

constexpr double kSquareCosine = 0.95;
constexpr std::size_t kMinSquareReturns = 4;  // of a patch
constexpr double kMaxSquareM = 2.0;           // farther ones are noise
constexpr double kNearM = 0.75;               // of the oblique returns: nearer ones show furniture
constexpr double kFarM = 2.5;
constexpr double kGrossShare = 0.2;  // of the range: such a return belongs to another wall
constexpr double kBandDeg = 10.0;
constexpr double kFirstBandDeg = 30.0;

struct Return {
  double range_m = 0.0;
  DrawnReturn drawn;
};

std::vector<Return> returns_of(const CorrectedRun& run, const BeamLayout& beams) {
  std::vector<Return> returns;
  for (std::size_t i = 0; i < run.samples.size(); ++i) {
    const Pose2& T = run.T_map_body[i];
    for (std::size_t beam = 0; beam < run.samples[i].beam_count; ++beam) {
      if (run.samples[i].status[beam] != RangeStatus::kHit) continue;
      const double range_m = run.samples[i].distance_m[beam];
      const double yaw_rad = T.yaw_rad() + beams.bearing_rad[beam];
      const Point2 direction{std::cos(yaw_rad), std::sin(yaw_rad)};
      returns.push_back(
          {range_m, {{T.x_m() + range_m * direction.x_m, T.y_m() + range_m * direction.y_m}, direction}});
    }
  }
  return returns;
}

/// Of a return on a patch.
struct Sight {
  double cosine = 0.0;    ///< of its angle of incidence
  double before_m = 0.0;  ///< how far before the patch's middle line it ends
  double range_m = 0.0;
};

Sight sight_of(const Return& seen, const WallPatch& patch) {
  const Point2& n = patch.normal_map;
  const Point2& p = seen.drawn.p_map;
  return {-(n.x_m * seen.drawn.direction_map.x_m + n.y_m * seen.drawn.direction_map.y_m),
          n.x_m * (p.x_m - patch.center_map.x_m) + n.y_m * (p.y_m - patch.center_map.y_m), seen.range_m};
}

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// Where squarely met returns say that the wall is.
std::optional<double> wall_before_m(const std::vector<Sight>& sights) {
  std::vector<double> before_m;
  for (const Sight& sight : sights)
    if (sight.cosine > kSquareCosine && sight.range_m < kMaxSquareM) before_m.push_back(sight.before_m);
  if (before_m.size() < kMinSquareReturns) return std::nullopt;
  return median(std::move(before_m));
}

/// By band of the angle of incidence: errors of ranges, as shares of the true ones.
using Errors = std::array<std::vector<double>, 4>;

void add_oblique(const std::vector<Sight>& sights, double wall_m, Errors& errors) {
  for (const Sight& sight : sights) {
    if (sight.cosine <= 0.0) continue;
    const double true_m = sight.range_m + (sight.before_m - wall_m) / sight.cosine;
    const double error = (sight.range_m - true_m) / true_m;
    const double band = (degrees(std::acos(std::min(1.0, sight.cosine))) - kFirstBandDeg) / kBandDeg;
    if (true_m < kNearM || true_m > kFarM || std::abs(error) > kGrossShare) continue;
    if (band >= 0.0 && band < static_cast<double>(errors.size()))
      errors[static_cast<std::size_t>(band)].push_back(error);
  }
}

bool add_input(const char* uri, Errors& errors) {
  const auto source = open_sample_source(uri, {});
  if (!source) {
    std::fprintf(stderr, "oblique_returns: %s\n", source.error().message.c_str());
    return false;
  }
  const BeamLayout beams = (*source)->beams();
  const std::vector<Return> returns = returns_of(corrected_run(**source), beams);
  std::vector<DrawnReturn> drawn;
  for (const Return& seen : returns) drawn.push_back(seen.drawn);
  const WallPatches found = find_wall_patches(drawn);
  std::vector<std::vector<Sight>> sights(found.patches.size());
  for (std::size_t i = 0; i < returns.size(); ++i)
    if (found.patch_of[i] != WallPatches::kNone)
      sights[found.patch_of[i]].push_back(sight_of(returns[i], found.patches[found.patch_of[i]]));
  for (const std::vector<Sight>& of_patch : sights)
    if (const std::optional<double> wall_m = wall_before_m(of_patch)) add_oblique(of_patch, *wall_m, errors);
  return true;
}

void print(const Errors& errors) {
  std::printf("| incidence, deg | returns | mean error, %% of the range | median |\n|---|---:|---:|---:|\n");
  for (std::size_t band = 0; band < errors.size(); ++band) {
    const double from_deg = kFirstBandDeg + kBandDeg * static_cast<double>(band);
    const std::vector<double>& of_band = errors[band];
    if (of_band.empty()) continue;
    const double mean =
        std::accumulate(of_band.begin(), of_band.end(), 0.0) / static_cast<double>(of_band.size());
    std::printf("| %.0f to %.0f | %zu | %+.2f | %+.2f |\n", from_deg, from_deg + kBandDeg, of_band.size(),
                100.0 * mean, 100.0 * median(of_band));
  }
}

}  // namespace
}  // namespace swiftlet

int main(int argc, char** argv) {
  swiftlet::Errors errors;
  bool all = argc > 1;
  for (int i = 1; i < argc; ++i) all = swiftlet::add_input(argv[i], errors) && all;
  swiftlet::print(errors);
  return all ? 0 : 2;
}
