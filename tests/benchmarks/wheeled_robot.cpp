// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "tests/benchmarks/wheeled_robot.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>

#include "core/base/time.hpp"
#include "daemon/outputs/tum_trajectory.hpp"

namespace swiftlet {
namespace {

constexpr double kLongestDriveS = 1800.0;
constexpr double kStartsAfterS = 2.0;  // of standing
constexpr double kReachedM = 0.12;
constexpr double kTurnsOnTheSpotRad = 0.5;
constexpr double kSlowsDownM = 0.3;
constexpr double kTurnGainPerS = 2.5;
constexpr double kAccelerationMPerS2 = 1.0;
constexpr double kAccelerationRadPerS2 = 3.0;
constexpr double kReverseShare = 0.3;
constexpr double kGlassSeenFromCos = 0.99;  // nearly squarely; else ...
constexpr double kGlassMissed = 0.7;        // ... so often not
constexpr double kFlattestCos = 0.2;        // flatter rays meet the face of a thick wall where this one does
constexpr auto kFirstStamp = HostTime(std::chrono::seconds(1'000'000'000));

/// Follows waypoints.
class Driver {
 public:
  Driver(const WheeledRobot& robot, std::span<const Waypoint> way, NoiseSource& noise)
      : robot_(&robot), way_(way), noise_(&noise), T_world_robot_(start(way)) {}

  [[nodiscard]] const Pose2& T_world_robot() const { return T_world_robot_; }
  [[nodiscard]] bool has_arrived() const { return next_ == way_.size() && stands_s_ <= 0.0; }
  void step() {
    double speed_m_per_s = 0.0;
    double turn_rad_per_s = 0.0;
    if (stands_s_ > 0.0) {
      stands_s_ -= kDriveStepS;
    } else if (next_ < way_.size()) {
      steer(speed_m_per_s, turn_rad_per_s);
    }
    const double most_faster_m_per_s = kAccelerationMPerS2 * kDriveStepS;
    const double most_faster_rad_per_s = kAccelerationRadPerS2 * kDriveStepS;
    speed_m_per_s_ += std::clamp(speed_m_per_s - speed_m_per_s_, -most_faster_m_per_s, most_faster_m_per_s);
    turn_rad_per_s_ +=
        std::clamp(turn_rad_per_s - turn_rad_per_s_, -most_faster_rad_per_s, most_faster_rad_per_s);
    T_world_robot_ = T_world_robot_ * Pose2(speed_m_per_s_ * kDriveStepS, 0.0, turn_rad_per_s_ * kDriveStepS);
  }

 private:
  static Pose2 start(std::span<const Waypoint> way) {
    const Point2& from = way[0].position;
    const Point2& to = way[1].position;
    return {from.x_m, from.y_m, std::atan2(to.y_m - from.y_m, to.x_m - from.x_m)};
  }
  void steer(double& speed_m_per_s, double& turn_rad_per_s) {
    const Point2 ahead = T_world_robot_.inverse() * way_[next_].position;
    const double far_m = std::hypot(ahead.x_m, ahead.y_m);
    if (far_m < kReachedM) return arrive();
    const double off_rad = wrap_angle(std::atan2(ahead.y_m, ahead.x_m) + (is_reversing_ ? kPi : 0.0));
    turn_rad_per_s =
        std::clamp(kTurnGainPerS * off_rad, -robot_->top_turn_rad_per_s, robot_->top_turn_rad_per_s);
    if (std::abs(off_rad) > kTurnsOnTheSpotRad) return;
    const double wanted_m_per_s =
        robot_->top_speed_m_per_s * std::cos(off_rad) * std::min(1.0, far_m / kSlowsDownM);
    speed_m_per_s = is_reversing_ ? -wanted_m_per_s : wanted_m_per_s;
  }
  void arrive() {
    stands_s_ = way_[next_].hover_s;
    ++next_;
    is_reversing_ =
        next_ < way_.size() && way_[next_].heading == PilotHeading::kKeep && noise_->chance(kReverseShare);
  }

  const WheeledRobot* robot_;
  std::span<const Waypoint> way_;
  NoiseSource* noise_;
  Pose2 T_world_robot_;
  std::size_t next_ = 1;
  double stands_s_ = kStartsAfterS;
  bool is_reversing_ = false;
  double speed_m_per_s_ = 0.0;
  double turn_rad_per_s_ = 0.0;
};

/// What the wheels report of a step without sideways motion.
Pose2 measured_by_wheels(const WheelErrors& errors, const Pose2& step, NoiseSource& noise) {
  const double chord_m = std::copysign(std::hypot(step.x_m(), step.y_m()), step.x_m());
  const double way_m = std::abs(chord_m);
  const double turn_rad = std::abs(step.yaw_rad());
  const double measured_m =
      errors.metre_scale * chord_m + noise.gaussian(errors.way_sigma_m * std::sqrt(way_m));
  double yaw_rad = errors.turn_scale * step.yaw_rad() + errors.missed_yaw_per_metre_rad * chord_m +
                   noise.gaussian(errors.yaw_sigma_by_way_rad * std::sqrt(way_m)) +
                   noise.gaussian(errors.yaw_sigma_by_turn_rad * std::sqrt(turn_rad));
  if (noise.chance(errors.slips_per_metre * way_m)) yaw_rad += noise.gaussian(errors.slip_sigma_rad);
  return {measured_m * std::cos(yaw_rad / 2.0), measured_m * std::sin(yaw_rad / 2.0), yaw_rad};
}

double reading_m(const LaserScanner& scanner, const std::optional<RayHit>& hit, double wall_thickness_m,
                 NoiseSource& noise) {
  if (noise.chance(scanner.stray_share)) return noise.uniform(0.1, scanner.max_range_m);
  if (!hit) return scanner.no_return_m;
  const bool is_missed = hit->surface == WallSurface::kGlass && hit->cos_incidence < kGlassSeenFromCos &&
                         noise.chance(kGlassMissed);
  const double face_m = hit->distance_m - 0.5 * wall_thickness_m / std::max(kFlattestCos, hit->cos_incidence);
  const double measured_m = face_m + noise.gaussian(scanner.range_sigma_m);
  return is_missed || measured_m <= 0.0 || measured_m >= scanner.max_range_m ? scanner.no_return_m
                                                                             : measured_m;
}

template <typename... Values>
void append(std::string& text, const char* format, Values... values) {
  char line[256];
  const int length = std::snprintf(line, sizeof line, format, values...);
  text.append(line, static_cast<std::size_t>(length));
}

/// The beginning of a FLASER line. Of an odd number the last one closes the half circle.
void append_readings(const LaserScanner& scanner, const Pose2& T_world_laser,
                     std::span<const WallSegment> walls, double wall_thickness_m, NoiseSource& noise,
                     std::string& text) {
  const double step_rad = kPi / static_cast<double>(scanner.readings - scanner.readings % 2);
  append(text, "FLASER %zu", scanner.readings);
  for (std::size_t i = 0; i < scanner.readings; ++i) {
    const double bearing_rad = static_cast<double>(i) * step_rad - kPi / 2.0;
    const std::optional<RayHit> hit =
        cast_ray(walls, T_world_laser.position(), T_world_laser.yaw_rad() + bearing_rad, scanner.max_range_m);
    append(text, " %.2f", reading_m(scanner, hit, wall_thickness_m, noise));
  }
}

}  // namespace

WheeledRobot draw_robot(std::uint64_t seed) {
  NoiseSource noise(seed, "robot");
  WheeledRobot robot;
  robot.top_speed_m_per_s = noise.uniform(0.25, 0.8);
  robot.top_turn_rad_per_s = noise.uniform(0.5, 1.2);
  robot.wheels = {.metre_scale = 1.0 + noise.gaussian(0.02),
                  .turn_scale = 1.0 + noise.gaussian(0.03),
                  .missed_yaw_per_metre_rad = noise.gaussian(radians(0.6)),
                  .way_sigma_m = noise.uniform(0.01, 0.04),
                  .yaw_sigma_by_way_rad = noise.uniform(radians(0.3), radians(2.0)),
                  .yaw_sigma_by_turn_rad = noise.uniform(0.01, 0.06),
                  .slips_per_metre = noise.chance(0.2) ? 1.0 / 15.0 : 0.0,
                  .slip_sigma_rad = radians(8.0)};
  LaserScanner& scanner = robot.scanner;
  scanner.readings = noise.chance(0.5) ? 181 : 360;
  scanner.rate_hz = noise.uniform(3.0, 12.0);
  const bool is_near = noise.chance(0.3);
  const bool is_middling = noise.chance(0.5);
  scanner.max_range_m = is_near ? 8.19 : is_middling ? 30.0 : 80.0;
  scanner.no_return_m = scanner.max_range_m + (is_near ? 0.0 : 0.83);
  scanner.range_sigma_m = noise.uniform(0.005, 0.03);
  scanner.stray_share = 0.003;
  scanner.lever_m = noise.uniform(-0.1, 0.3);
  scanner.lag_s = noise.chance(0.5) ? 0.0 : noise.uniform(-0.1, 0.15);
  return robot;
}

std::vector<Pose2> drive(const WheeledRobot& robot, std::span<const Waypoint> way, NoiseSource& noise) {
  Driver driver(robot, way, noise);
  std::vector<Pose2> T_world_robot{driver.T_world_robot()};
  const auto most = static_cast<std::size_t>(kLongestDriveS / kDriveStepS);
  while (!driver.has_arrived() && T_world_robot.size() < most) {
    driver.step();
    T_world_robot.push_back(driver.T_world_robot());
  }
  return T_world_robot;
}

RobotLog log_drive(const WheeledRobot& robot, std::span<const Pose2> T_world_robot,
                   std::span<const WallSegment> walls, double wall_thickness_m, NoiseSource& wheel_noise,
                   NoiseSource& laser_noise) {
  const LaserScanner& scanner = robot.scanner;
  const Pose2 T_robot_laser(scanner.lever_m, 0.0, 0.0);
  const auto at = [&](double time_s) {
    const double step = std::round(std::max(time_s, 0.0) / kDriveStepS);
    return T_world_robot[std::min(static_cast<std::size_t>(step), T_world_robot.size() - 1)];
  };
  RobotLog log;
  Pose2 T_odom_robot;
  Pose2 T_world_before = T_world_robot.front();
  const double end_s = static_cast<double>(T_world_robot.size() - 1) * kDriveStepS;
  for (int scan = 0; scan / scanner.rate_hz <= end_s; ++scan) {
    const double time_s = scan / scanner.rate_hz;
    const Pose2 T_world_now = at(time_s);
    T_odom_robot =
        T_odom_robot * measured_by_wheels(robot.wheels, between(T_world_before, T_world_now), wheel_noise);
    T_world_before = T_world_now;
    const Pose2 T_world_laser = at(time_s - scanner.lag_s) * T_robot_laser;
    append_readings(scanner, T_world_laser, walls, wall_thickness_m, laser_noise, log.flaser);
    const Pose2 T_odom_laser = T_odom_robot * T_robot_laser;
    for (const Pose2& T : {T_odom_laser, T_odom_robot})
      append(log.flaser, " %.6f %.6f %.6f", T.x_m(), T.y_m(), T.yaw_rad());
    const HostTime stamp = kFirstStamp + std::chrono::microseconds(std::llround(time_s * 1e6));
    append(log.flaser, " %.6f robot %.6f\n", to_seconds(stamp.time_since_epoch()), time_s);
    append_tum_line(log.truth, stamp, T_world_now * T_robot_laser);
  }
  return log;
}

}  // namespace swiftlet
