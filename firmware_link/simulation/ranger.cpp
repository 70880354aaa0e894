// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "firmware_link/simulation/ranger.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

namespace swiftlet {
namespace {

constexpr std::size_t kRaysEachSide = 4;
constexpr std::size_t kRays = 2 * kRaysEachSide + 1;
constexpr double kMergedBehindM = 0.4;  // closer together than that, two returns are one pulse
constexpr std::int32_t kNotValidMm = 32767;
constexpr double kPhantomsToM = 4.0;
constexpr double kWildest = 20.0;

/// Rays evenly across the cone, each with the share of the round field of view that stands above and below it
/// (walls are upright, so a plane of rays is enough).
struct ConeRay {
  double offset;  // of the half cone, -1..1
  double gain;
};
std::array<ConeRay, kRays> cone_rays() {
  std::array<ConeRay, kRays> rays{};
  for (std::size_t i = 0; i < kRays; ++i) {
    const double offset = (static_cast<double>(i) - kRaysEachSide) / (kRaysEachSide + 1);
    rays[i] = {offset, std::sqrt(1.0 - offset * offset)};
  }
  return rays;
}

/// What the sensor is calibrated for at the factory: a wide target met squarely at 1 m. Distances are divided
/// by `distance_m`, light by `light`.
struct Calibration {
  double distance_m;
  double light;
};
Calibration calibrate(const RangerModel& model) {
  double light = 0.0;
  double moment = 0.0;
  for (const ConeRay& ray : cone_rays()) {
    const double cosine = std::cos(ray.offset * model.half_cone_rad);
    const double weight = ray.gain * cosine * cosine * cosine;  // distance 1 / cosine, incidence cosine
    light += weight;
    moment += weight / cosine;
  }
  return {moment / light, light};
}

double sigma_at_m(std::span<const NoiseAtRange> noise, double distance_m) {
  for (std::size_t i = 1; i < noise.size(); ++i) {
    const auto& [from_m, from_sigma_m] = noise[i - 1];
    const auto& [to_m, to_sigma_m] = noise[i];
    if (distance_m >= to_m) continue;
    const double share = std::max(0.0, (distance_m - from_m) / (to_m - from_m));
    return from_sigma_m + share * (to_sigma_m - from_sigma_m);
  }
  return noise.back().sigma_m;
}

/// Three standard deviations and more: half of these errors exceed four, a ninth nine.
double wild_error(NoiseSource& noise) {
  return noise.either_sign(std::min(kWildest, 3.0 / std::sqrt(noise.uniform(0.02, 1.0))));
}

}  // namespace

std::optional<ConeReturn> look_through_cone(std::span<const WallSegment> walls, const Point2& origin,
                                            double direction_rad, const RangerModel& model) {
  const std::array<ConeRay, kRays> rays = cone_rays();
  std::array<std::optional<RayHit>, kRays> hits;
  double nearest_m = model.max_range_m;
  for (std::size_t i = 0; i < kRays; ++i) {
    hits[i] =
        cast_ray(walls, origin, direction_rad + rays[i].offset * model.half_cone_rad, model.max_range_m);
    if (hits[i]) nearest_m = std::min(nearest_m, hits[i]->distance_m);
  }
  double light = 0.0;
  double moment = 0.0;
  for (std::size_t i = 0; i < kRays; ++i) {
    if (!hits[i] || hits[i]->distance_m > nearest_m + kMergedBehindM) continue;
    const double d = std::max(hits[i]->distance_m, 1e-3);
    const double sent_back = hits[i]->surface == WallSurface::kDark ? model.dark_share : 1.0;
    const double weight = sent_back * rays[i].gain * hits[i]->cos_incidence / (d * d);
    light += weight;
    moment += weight * d;
  }
  if (light <= 0.0) return std::nullopt;
  const Calibration calibration = calibrate(model);
  return ConeReturn{moment / light / calibration.distance_m, std::sqrt(calibration.light / light)};
}

std::optional<double> measure_range(std::span<const WallSegment> walls, const Point2& origin,
                                    double direction_rad, const RangerModel& model, NoiseSource& noise) {
  // Both are always drawn, so that a lost reading does not shift the noise of the next.
  const double fate = noise.uniform(0.0, 1.0);
  const double unit_error = noise.gaussian(1.0);
  const std::optional<ConeReturn> seen = look_through_cone(walls, origin, direction_rad, model);
  if (!seen || seen->distance_m > model.max_range_m) return std::nullopt;
  const double lost = model.lost_anyway +
                      1.0 / (1.0 + std::exp((model.half_lost_at_m - seen->dimness_m) / model.lost_within_m));
  if (fate < lost) return std::nullopt;
  if (model.noise_by_range.empty()) {
    const double sigma_m = model.noise_floor_m + model.noise_share * seen->distance_m;
    return std::max(0.0, seen->distance_m + sigma_m * unit_error);
  }
  if (seen->distance_m > kPhantomsFromM && noise.chance(model.phantom_share))
    return noise.uniform(kPhantomsFromM, kPhantomsToM);
  const double error = noise.chance(model.wild_share) ? wild_error(noise) : unit_error;
  return std::max(0.0, seen->distance_m + sigma_at_m(model.noise_by_range, seen->distance_m) * error);
}

double logged_range_mm(std::optional<double> range_m) {
  const std::int32_t measured_mm =
      range_m ? static_cast<std::int32_t>(std::lround(*range_m * 1000.0)) : kNotValidMm;
  // The firmware turns millimetres into metres and back in single precision and cuts off the rest: 32767
  // becomes 32766, and 21 readings below 4000 come out one short.
  const float metres = static_cast<float>(measured_mm) / 1000.0F;
  const float millimetres = metres * 1000.0F;
  return std::floor(static_cast<double>(millimetres));
}

}  // namespace swiftlet
