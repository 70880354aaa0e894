// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
// Flies through the simulated office and calibrates from the flight as `swiftlet calibrate` does: JSON with
// what the simulation knows of its sensors' errors beside what was found. For tools/benchmark-calibration.
#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <charconv>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <functional>
#include <memory>
#include <nlohmann/json.hpp>
#include <numeric>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/sensing/systematic_motion.hpp"
#include "firmware_link/input/link_sample_source.hpp"
#include "firmware_link/simulation/link.hpp"
#include "firmware_link/simulation/ranger.hpp"
#include "firmware_link/simulation/world.hpp"
#include "tools/calibration/calibration_rounds.hpp"

namespace swiftlet {
namespace {

constexpr const char* kUsage =
    "usage: calibration_flights SEED [RANGE_AGE_MS SCALE_SPREAD TURN_SCALE_SPREAD]";
constexpr const char* kWorld = "office";

// Ages that are tried for the true one: from that of a reading just published to that of one which waited a
// whole period for its log packet, and a little longer.
constexpr Duration kAgeStep = std::chrono::milliseconds(10);
constexpr Duration kMaxDelay = std::chrono::milliseconds(30);
// A reading that is farther off shows another wall, not another age. Far readings show little of either.
constexpr double kFarthestOffM = 0.06;
constexpr double kFarthestReadingM = 2.0;
constexpr std::size_t kStretches = 8;  // of a flight, to see whether the age changes in it

struct Flight {
  std::uint64_t seed = 1;
  VehicleModel vehicle;
};

/// Receives each sample while the link still has the truth of its time.
using Witness = std::function<void(const RangeSample& sample, SimulatedLink& link)>;

/// The flight of `sim://office?seed=N`, if the vehicle is the default one.
Result<PairedRun> fly(const Flight& flight, std::optional<Duration> range_age, const Witness& witness) {
  const Result<SimulatedWorld> world = make_simulated_world(kWorld);
  if (!world) return world.error();
  auto link =
      std::make_unique<SimulatedLink>(*world, flight.vehicle, SimulatedLink::kPacketLoss, flight.seed);
  SimulatedLink& flown = *link;
  LinkInput input;
  input.name = kWorld;
  if (range_age) input.sensor.range_age = *range_age;
  input.starts_logging = true;
  input.link = std::move(link);
  LinkSampleSource source(std::move(input));
  PairedRun run{{}, source.beams(), source.sensor()};
  for (;;) {
    const Result<ReceivedSample> received = source.next();
    if (received) {
      run.samples.push_back(received->sample);
      witness(received->sample, flown);
    } else if (received.error().code == ErrorCode::kEndOfRecording) {
      return run;
    } else if (received.error().code != ErrorCode::kTimeout) {
      return received.error();
    }
  }
}

std::vector<Duration> possible_ages(const VehicleModel& vehicle) {
  std::vector<Duration> ages;
  const Duration last = vehicle.range_age + vehicle.range_period + kMaxDelay;
  for (Duration age = vehicle.range_age; age <= last; age += kAgeStep) ages.push_back(age);
  return ages;
}

/// One figure for each possible age: how far readings are off if they are so old, squared.
using Misfits = Eigen::VectorXd;

/// Of one sample from where the vehicle truly was at that age.
double misfit(const RangeSample& sample, const BeamLayout& beams, const Pose2& T_world_body,
              std::span<const WallSegment> walls) {
  double sum = 0.0;
  for (std::size_t beam = 0; beam < sample.beam_count; ++beam) {
    const double measured_m = sample.distance_m[beam];
    if (sample.status[beam] != RangeStatus::kHit || measured_m > kFarthestReadingM) continue;
    const std::optional<ConeReturn> seen = look_through_cone(
        walls, T_world_body.position(), T_world_body.yaw_rad() + beams.bearing_rad[beam], RangerModel{});
    const double off_m = seen ? std::abs(seen->distance_m - measured_m) : kFarthestOffM;
    sum += std::pow(std::min(off_m, kFarthestOffM), 2);
  }
  return sum;
}

/// The age that fits best: of a parabola through the least misfit and its neighbours.
double best_age_s(const std::vector<Duration>& ages, const Misfits& misfits) {
  Eigen::Index best = 0;
  misfits.minCoeff(&best);
  const double age_s = to_seconds(ages[static_cast<std::size_t>(best)]);
  if (best == 0 || best + 1 == misfits.size()) return age_s;
  const double before = misfits(best - 1);
  const double after = misfits(best + 1);
  return age_s + to_seconds(kAgeStep) * 0.5 * (before - after) / (before - 2.0 * misfits(best) + after);
}

/// A flight and what the simulation knows of it.
struct WatchedFlight {
  PairedRun run;
  std::vector<Duration> ages;       // that are possible
  std::vector<Misfits> misfits;     // of each sample
  std::vector<Pose2> T_world_body;  // at each sample's measured_at
};

struct TrueAge {
  double whole_s = 0.0;  ///< of the flight
  double min_s = 0.0;    ///< of its stretches
  double max_s = 0.0;    ///< likewise
};

TrueAge true_age(const WatchedFlight& flight) {
  const auto age_of = [&](std::size_t first, std::size_t last) {
    const auto at = [&](std::size_t i) { return flight.misfits.begin() + static_cast<std::ptrdiff_t>(i); };
    const Misfits none = Misfits::Zero(static_cast<Eigen::Index>(flight.ages.size()));
    return best_age_s(flight.ages, std::accumulate(at(first), at(last), none));
  };
  const std::size_t samples = flight.misfits.size();
  std::array<double, kStretches> stretches{};
  for (std::size_t i = 0; i < kStretches; ++i)
    stretches[i] = age_of(i * samples / kStretches, (i + 1) * samples / kStretches);
  const auto [least, greatest] = std::minmax_element(stretches.begin(), stretches.end());
  return {age_of(0, samples), *least, *greatest};
}

/// Regressions of what was measured of each step on what it truly was, for only what was measured has noise.
OdometryCalibration true_odometry(const WatchedFlight& flight) {
  const std::vector<CalibrationScan> scans = calibration_scans(flight.run.samples, flight.run.beams);
  const std::vector<Pose2>& T_world_body = flight.T_world_body;
  const SystematicMotion motion(odometry_of(scans));
  Eigen::Vector2d true_true = Eigen::Vector2d::Zero();
  Eigen::Vector2d true_measured = Eigen::Vector2d::Zero();
  Eigen::Matrix2d yaw_normal = Eigen::Matrix2d::Zero();
  Eigen::Vector2d yaw_missed = Eigen::Vector2d::Zero();
  for (std::size_t i = 1; i < scans.size(); ++i) {
    const Eigen::Vector3d measured = motion.measured(i).vector();
    if (!motion.is_known(i) || measured.isZero(0.0)) continue;
    const Eigen::Vector3d moved = between(T_world_body[i - 1], T_world_body[i]).vector();
    true_true += moved.head<2>().cwiseAbs2();
    true_measured += moved.head<2>().cwiseProduct(measured.head<2>());
    const Eigen::Vector2d causes(moved(2), to_seconds(scans[i].measured_at - scans[i - 1].measured_at));
    yaw_normal += causes * causes.transpose();
    yaw_missed += causes * wrap_angle(moved(2) - measured(2));
  }
  const Eigen::Vector2d scales = true_true.cwiseQuotient(true_measured);
  const Eigen::Vector2d of_true = yaw_normal.ldlt().solve(yaw_missed);
  const double measured_per_true = 1.0 - of_true(0);
  return {scales(0), scales(1), 0.0, of_true(0) / measured_per_true, of_true(1) / measured_per_true};
}

Result<WatchedFlight> watch(const Flight& flight) {
  const Result<SimulatedWorld> world = make_simulated_world(kWorld);
  if (!world) return world.error();
  WatchedFlight watched{{}, possible_ages(flight.vehicle), {}, {}};
  const Duration assumed = SensorModel::crazyflie().range_age;
  const BeamLayout beams = BeamLayout::multiranger();
  Result<PairedRun> run = fly(flight, assumed, [&](const RangeSample& sample, SimulatedLink& link) {
    watched.T_world_body.push_back(link.T_world_body(sample.measured_at));
    Misfits misfits(static_cast<Eigen::Index>(watched.ages.size()));
    std::transform(watched.ages.begin(), watched.ages.end(), misfits.begin(), [&](Duration age) {
      return misfit(sample, beams, link.T_world_body(sample.measured_at + assumed - age), world->walls);
    });
    watched.misfits.push_back(std::move(misfits));
  });
  if (!run) return run.error();
  watched.run = std::move(run).value();
  return watched;
}

nlohmann::ordered_json figure(const CalibrationFinding& finding, double truth) {
  nlohmann::ordered_json json{
      {"setting", "sensor." + finding.setting}, {"true", truth}, {"found", nullptr}, {"sigma", nullptr}};
  if (finding.verdict == CalibrationFinding::Verdict::kNotObservable) return json;
  json["found"] = finding.value;
  json["sigma"] = finding.sigma;
  return json;
}

Result<nlohmann::ordered_json> measure(const Flight& flight) {
  const Result<WatchedFlight> watched = watch(flight);
  if (!watched) return watched.error();
  const Result<CalibrationReport> report = calibrate_in_rounds(
      kWorld,
      [&](std::optional<Duration> range_age) {
        return fly(flight, range_age, [](const RangeSample&, SimulatedLink&) {});
      },
      [](double) { return true; });
  if (!report) return report.error();
  const TrueAge age = true_age(*watched);
  const OdometryCalibration odometry = true_odometry(*watched);
  nlohmann::ordered_json json{
      {"seed", flight.seed},    {"samples", report->samples}, {"sideways_m", report->motion.sideways_m},
      {"min_age_s", age.min_s}, {"max_age_s", age.max_s},     {"figures", nlohmann::ordered_json::array()}};
  const std::array<double, kSystematicErrors> truths{age.whole_s,
                                                     odometry.forward_scale,
                                                     odometry.sideways_scale,
                                                     odometry.yaw_per_metre_rad,
                                                     odometry.yaw_per_radian,
                                                     odometry.yaw_per_second_rad};
  for (std::size_t i = 0; i < truths.size(); ++i)
    json["figures"].push_back(figure(report->findings[i], truths[i]));
  return json;
}

template <typename Number>
std::optional<Number> parsed(std::string_view text) {
  Number number{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
  return number;
}

std::optional<Flight> flight_of(std::span<char* const> arguments) {
  if (arguments.size() != 2 && arguments.size() != 5) return std::nullopt;
  Flight flight;
  const std::optional<std::uint64_t> seed = parsed<std::uint64_t>(arguments[1]);
  if (!seed) return std::nullopt;
  flight.seed = *seed;
  if (arguments.size() == 2) return flight;
  const std::optional<std::uint16_t> age_ms = parsed<std::uint16_t>(arguments[2]);
  const std::optional<double> scale_spread = parsed<double>(arguments[3]);
  const std::optional<double> turn_scale_spread = parsed<double>(arguments[4]);
  if (!age_ms || !scale_spread || !turn_scale_spread) return std::nullopt;
  flight.vehicle.range_age = std::chrono::milliseconds(*age_ms);
  flight.vehicle.odometry.scale_spread = *scale_spread;
  flight.vehicle.odometry.turn_scale_spread = *turn_scale_spread;
  return flight;
}

int run(std::span<char* const> arguments) {
  const std::optional<Flight> flight = flight_of(arguments);
  if (!flight) {
    std::fprintf(stderr, "%s\n", kUsage);
    return 2;
  }
  const Result<nlohmann::ordered_json> measured = measure(*flight);
  if (!measured) {
    std::fprintf(stderr, "calibration_flights: %s\n", measured.error().message.c_str());
    return 2;
  }
  std::printf("%s\n", measured->dump(2).c_str());
  return 0;
}

}  // namespace
}  // namespace swiftlet

int main(int argc, char** argv) {
  try {
    return swiftlet::run({argv, static_cast<std::size_t>(argc)});
  } catch (const std::exception& error) {  // out of memory, or a fault of a library's
    std::fprintf(stderr, "calibration_flights: %s\n", error.what());
    return 2;
  }
}
