// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "firmware_link/laser_log/carmen_log.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <chrono>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>
#include <span>
#include <utility>

#include "core/geometry/angle.hpp"
#include "firmware_link/file/gzip_lines.hpp"
#include "firmware_link/laser_log/scan_geometry.hpp"

namespace swiftlet {
namespace {

constexpr std::size_t kMaxNamedLines = 10;
constexpr std::size_t kMaxReadings = 10'000;  // of any laser
constexpr double kMinStepRad = 1e-4;          // a fortieth of the finest scanner's
constexpr const char* kOtherGeometry =
    "scan whose beams lie elsewhere than the first one's, or are fewer than are to be kept";

/// The numbers of a line, one after the other.
class Numbers {
 public:
  explicit Numbers(std::string_view text) : text_(text) {}

  template <typename Number>
  bool read(Number& number) {
    const std::size_t start = std::min(text_.find_first_not_of(" \t"), text_.size());
    const char* end = text_.data() + text_.size();
    const auto [rest, error] = std::from_chars(text_.data() + start, end, number);
    if (error != std::errc{} || (rest != end && *rest != ' ' && *rest != '\t')) return false;
    text_.remove_prefix(static_cast<std::size_t>(rest - text_.data()));
    return true;
  }

 private:
  std::string_view text_;
};

bool read_odometry_pose(Numbers& numbers, CarmenOdometry& odometry) {
  const bool is_pose = numbers.read(odometry.position.x_m) && numbers.read(odometry.position.y_m) &&
                       numbers.read(odometry.yaw_rad);
  odometry.is_zero = odometry.position.x_m == 0.0 && odometry.position.y_m == 0.0 && odometry.yaw_rad == 0.0;
  return is_pose && std::isfinite(odometry.position.x_m) && std::isfinite(odometry.position.y_m) &&
         std::isfinite(odometry.yaw_rad);
}

/// Stamps are logged in microseconds: the nearest one undoes the rounding of the binary number.
bool read_stamp(Numbers& numbers, HostTime& stamp) {
  double seconds = 0.0;
  if (!numbers.read(seconds) || !(seconds >= 0.0 && seconds < 4e9)) return false;
  stamp = HostTime(std::chrono::microseconds(std::llround(seconds * 1e6)));
  return true;
}

/// What stands before the readings of ROBOTLASER1 and RAWLASER1 lines.
std::optional<ScanGeometry> read_geometry(Numbers& numbers, double& max_range_m) {
  ScanGeometry geometry;
  double ignored = 0.0;
  const bool is_complete = numbers.read(ignored) && numbers.read(geometry.start_rad) &&
                           numbers.read(ignored) && numbers.read(geometry.step_rad) &&
                           numbers.read(max_range_m) && numbers.read(ignored) && numbers.read(ignored) &&
                           numbers.read(geometry.readings);
  const bool is_possible = std::abs(geometry.start_rad) <= 2.0 * kPi && geometry.step_rad >= kMinStepRad &&
                           geometry.readings >= 1 && geometry.readings <= kMaxReadings &&
                           geometry.step_rad * static_cast<double>(geometry.readings) <= 2.1 * kPi;
  return is_complete && is_possible ? std::optional(geometry) : std::nullopt;
}

bool skip_counted(Numbers& numbers) {
  std::size_t count = 0;
  double ignored = 0.0;
  bool is_complete = numbers.read(count);
  for (; is_complete && count > 0; --count) is_complete = numbers.read(ignored);
  return is_complete;
}

Pose2 pose_of(const CarmenOdometry& odometry) {
  return {odometry.position.x_m, odometry.position.y_m, odometry.yaw_rad};
}

/// Where the laser is on the robot, from lines that have a pose of each. Of a FLASER line the first may also
/// be another program's estimate: that moves against the odometry, what is screwed on does not.
class Mounting {
 public:
  void add(const CarmenOdometry& laser, const CarmenOdometry& robot) {
    if (laser.is_zero && robot.is_zero) return;  // the base had not reported yet
    const Pose2 T_robot_laser = pose_of(robot).inverse() * pose_of(laser);
    if (!T_robot_laser_) T_robot_laser_ = T_robot_laser;
    is_fixed_ = is_fixed_ && is_rounding(T_robot_laser_->inverse() * T_robot_laser);
  }
  /// Of the first line; nullopt: there was none.
  [[nodiscard]] const std::optional<Pose2>& T_robot_laser() const { return T_robot_laser_; }
  /// nullopt: what the lines have is no mounting, or none that matters.
  [[nodiscard]] std::optional<Pose2> T_robot_laser_if_fixed() const {
    const bool is_one = T_robot_laser_ && is_fixed_ && !is_rounding(*T_robot_laser_) &&
                        std::hypot(T_robot_laser_->x_m(), T_robot_laser_->y_m()) < kMaxLeverM;
    return is_one ? T_robot_laser_ : std::nullopt;
  }

 private:
  static constexpr double kMaxLeverM = 1.0;
  /// Of poses in two decimals: four of them, half a hundredth in each number.
  static bool is_rounding(const Pose2& T) {
    return std::hypot(T.x_m(), T.y_m()) < 0.03 && std::abs(T.yaw_rad()) < 0.025;
  }
  std::optional<Pose2> T_robot_laser_;
  bool is_fixed_ = true;
};

void move(const Pose2& T_logged_moved, std::vector<CarmenOdometry>& poses) {
  for (CarmenOdometry& logged : poses) {
    const Pose2 moved = pose_of(logged) * T_logged_moved;
    logged.position = moved.position();
    logged.yaw_rad = moved.yaw_rad();
  }
}

/// From the least to the most telling.
enum class ScanLine : std::uint8_t { kNone, kRawLaser, kRobotLaser, kFlaser };

const char* name_of(ScanLine kind) {
  static constexpr std::array<const char*, 4> kNames{"", "RAWLASER1", "ROBOTLASER1", "FLASER"};
  return kNames[static_cast<std::size_t>(kind)];
}

/// Collects the lines of one log.
class CarmenParser {
 public:
  CarmenParser(std::string path, std::size_t beam_count) : path_(std::move(path)), beam_count_(beam_count) {}

  void parse_line(std::string_view line, std::uint64_t number) {
    log_.lines = number;
    const char* fault = nullptr;
    if (line.starts_with("FLASER ")) fault = parse_flaser(Numbers(line.substr(7)));
    if (line.starts_with("ROBOTLASER1 ")) fault = parse_robot_laser(Numbers(line.substr(12)));
    if (line.starts_with("RAWLASER1 ")) fault = parse_raw_laser(Numbers(line.substr(10)));
    if (line.starts_with("ODOM ")) fault = parse_odometry(Numbers(line.substr(5)));
    if (fault == nullptr) return;
    if (++malformed_ <= kMaxNamedLines)
      log_.problems.push_back(path_ + ":" + std::to_string(number) + ": " + fault + "; the line is left out");
  }

  void add_problem(const std::string& problem) { log_.problems.push_back(problem); }

  CarmenLog finish() {
    if (malformed_ > kMaxNamedLines)
      log_.problems.push_back(path_ + ": " + std::to_string(malformed_ - kMaxNamedLines) +
                              " more malformed lines were left out");
    log_.beams = beams_;
    log_.scans_have_poses = kind_ != ScanLine::kRawLaser;
    sort_scans();
    const bool has_robot_poses = kind_ == ScanLine::kFlaser;
    const std::optional<Pose2> T_robot_laser =
        has_robot_poses ? mounting_.T_robot_laser_if_fixed() : mounting_.T_robot_laser();
    if (T_robot_laser) place_body(*T_robot_laser, has_robot_poses);
    std::stable_sort(log_.odometry.begin(), log_.odometry.end(), earlier);
    return std::move(log_);
  }

 private:
  static bool earlier(const CarmenOdometry& a, const CarmenOdometry& b) { return a.stamp < b.stamp; }

  /// What is wrong with the line, or nullptr; likewise below.
  const char* parse_flaser(Numbers numbers) {
    std::size_t readings = 0;
    const bool is_counted = numbers.read(readings);
    const std::optional<ScanGeometry> geometry = usual_geometry(readings);
    if (!is_counted || !geometry) return "FLASER with a number of readings that no known scanner has";
    if (!accepts(ScanLine::kFlaser, *geometry)) return kOtherGeometry;
    CarmenOdometry laser;
    CarmenOdometry robot;
    if (!read_distances(numbers, *geometry) || !read_odometry_pose(numbers, laser) ||
        !read_odometry_pose(numbers, robot) || !read_stamp(numbers, robot.stamp))
      return "FLASER line cut off or garbled";
    add_scan(ScanLine::kFlaser, *geometry, robot);
    mounting_.add(laser, robot);
    return nullptr;
  }

  const char* parse_robot_laser(Numbers numbers) {
    if (kind_ > ScanLine::kRobotLaser) return nullptr;
    double max_range_m = 0.0;
    const std::optional<ScanGeometry> geometry = read_geometry(numbers, max_range_m);
    if (!geometry) return "ROBOTLASER1 line cut off or garbled";
    if (!accepts(ScanLine::kRobotLaser, *geometry)) return kOtherGeometry;
    CarmenOdometry laser;
    CarmenOdometry robot;
    double ignored = 0.0;
    bool is_complete = read_distances(numbers, *geometry) && skip_counted(numbers) &&
                       read_odometry_pose(numbers, laser) && read_odometry_pose(numbers, robot);
    for (int i = 0; i < 5; ++i) is_complete = is_complete && numbers.read(ignored);
    if (!is_complete || !read_stamp(numbers, laser.stamp)) return "ROBOTLASER1 line cut off or garbled";
    CarmenOdometry scan = laser;
    scan.is_zero = robot.is_zero;
    add_scan(ScanLine::kRobotLaser, *geometry, scan);
    log_.max_range_m = max_range_m;
    mounting_.add(laser, robot);
    return nullptr;
  }

  const char* parse_raw_laser(Numbers numbers) {
    if (kind_ > ScanLine::kRawLaser) return nullptr;
    double max_range_m = 0.0;
    const std::optional<ScanGeometry> geometry = read_geometry(numbers, max_range_m);
    if (!geometry) return "RAWLASER1 line cut off or garbled";
    if (!accepts(ScanLine::kRawLaser, *geometry)) return kOtherGeometry;
    CarmenOdometry scan;
    if (!read_distances(numbers, *geometry) || !skip_counted(numbers) || !read_stamp(numbers, scan.stamp))
      return "RAWLASER1 line cut off or garbled";
    add_scan(ScanLine::kRawLaser, *geometry, scan);
    log_.max_range_m = max_range_m;
    return nullptr;
  }

  /// Scans of a more telling kind than those so far, and of their kind those that have most of the beams.
  /// Follows a changed resolution.
  bool accepts(ScanLine kind, const ScanGeometry& geometry) {
    if (kind > kind_) return geometry.readings >= beam_count_;
    if (kind < kind_) return false;
    if (geometry != geometry_) follow(geometry);
    const auto missing = static_cast<std::size_t>(std::count(picked_.begin(), picked_.end(), kNoReading));
    return 2 * missing < picked_.size();
  }

  /// A scanner that was started with another resolution: the beams stay where they are.
  void follow(const ScanGeometry& geometry) {
    geometry_ = geometry;
    picked_ = readings_along(beams_, geometry);
    log_.pose_scan_lag.interrupt();
  }

  bool read_distances(Numbers& numbers, const ScanGeometry& geometry) {
    scratch_m_.resize(geometry.readings);
    return std::all_of(scratch_m_.begin(), scratch_m_.end(),
                       [&numbers](float& distance_m) { return numbers.read(distance_m); });
  }

  /// Of the distances that were read. The first of a more telling kind replaces what came before.
  void add_scan(ScanLine kind, const ScanGeometry& geometry, const CarmenOdometry& scan) {
    if (kind > kind_) begin_with(kind, geometry);
    if (!log_.scans.empty() && scan.stamp < log_.scans.back().stamp) {
      ++log_.scan_reversals;
      log_.longest_step_back = std::max(log_.longest_step_back, log_.scans.back().stamp - scan.stamp);
      log_.pose_scan_lag.interrupt();
    }
    if (kind != ScanLine::kRawLaser) log_.pose_scan_lag.add(scratch_m_, scan.yaw_rad, geometry.step_rad);
    log_.scans.push_back(scan);
    log_.scans.back().line = log_.lines;
    for (const std::size_t i : picked_)
      log_.distances_m.push_back(i == kNoReading ? std::numeric_limits<float>::quiet_NaN() : scratch_m_[i]);
  }

  void begin_with(ScanLine kind, const ScanGeometry& geometry) {
    kind_ = kind;
    log_.scan_line = name_of(kind);
    log_.scans.clear();
    log_.distances_m.clear();
    log_.scan_reversals = 0;
    log_.longest_step_back = {};
    log_.pose_scan_lag = {};
    log_.max_range_m = 0.0;
    mounting_ = {};
    choose_beams(geometry);
  }

  const char* parse_odometry(Numbers numbers) {
    CarmenOdometry odometry;
    double ignored = 0.0;
    if (!read_odometry_pose(numbers, odometry) || !numbers.read(ignored) || !numbers.read(ignored) ||
        !numbers.read(ignored) || !read_stamp(numbers, odometry.stamp))
      return "ODOM line cut off or garbled";
    if (!log_.odometry.empty() && odometry.stamp < log_.odometry.back().stamp) ++log_.odometry_reversals;
    log_.odometry.push_back(odometry);
    return nullptr;
  }

  void choose_beams(const ScanGeometry& geometry) {
    geometry_ = geometry;
    // Of a full circle the first reading would be the last, too.
    const std::size_t closing = geometry.is_full_circle() ? 1 : 0;
    picked_ = pick_beams(geometry.readings + closing, beam_count_ + closing);
    picked_.resize(beam_count_);
    beams_.count = static_cast<std::uint8_t>(picked_.size());
    for (std::size_t i = 0; i < picked_.size(); ++i)
      beams_.bearing_rad[i] = wrap_angle(geometry.bearing_rad(picked_[i]));
  }

  /// At the laser, with the robot's heading: dead reckoning errs along and across that.
  void place_body(const Pose2& T_robot_laser, bool scans_are_of_robot) {
    const Pose2 T_robot_body(T_robot_laser.x_m(), T_robot_laser.y_m(), 0.0);
    const Pose2 T_laser_body(0.0, 0.0, -T_robot_laser.yaw_rad());
    move(scans_are_of_robot ? T_robot_body : T_laser_body, log_.scans);
    move(T_robot_body, log_.odometry);
    for (double& bearing_rad : std::span(log_.beams.bearing_rad).first(log_.beams.count))
      bearing_rad = wrap_angle(bearing_rad + T_robot_laser.yaw_rad());
  }

  void sort_scans() {
    std::vector<std::size_t> order(log_.scans.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(),
                     [this](std::size_t a, std::size_t b) { return earlier(log_.scans[a], log_.scans[b]); });
    std::vector<CarmenOdometry> scans;
    std::vector<float> distances_m;
    scans.reserve(log_.scans.size());
    distances_m.reserve(log_.distances_m.size());
    for (const std::size_t i : order) {
      const std::span<const float> distances = log_.distances_of(i);
      const bool repeats = !scans.empty() && scans.back().stamp == log_.scans[i].stamp &&
                           std::equal(distances.begin(), distances.end(), distances_m.end() - beams_.count);
      if (repeats) {
        ++log_.duplicate_scans;
        continue;
      }
      scans.push_back(log_.scans[i]);
      distances_m.insert(distances_m.end(), distances.begin(), distances.end());
    }
    log_.scans = std::move(scans);
    log_.distances_m = std::move(distances_m);
  }

  std::string path_;
  std::size_t beam_count_;
  CarmenLog log_;
  BeamLayout beams_;
  ScanLine kind_ = ScanLine::kNone;
  ScanGeometry geometry_;
  Mounting mounting_;
  std::vector<std::size_t> picked_;  // of geometry_, for beams_
  std::vector<float> scratch_m_;
  std::uint64_t malformed_ = 0;
};

}  // namespace

Result<CarmenLog> read_carmen_log(const std::string& path, std::size_t beam_count) {
  Result<GzipLines> lines = GzipLines::open(path);
  if (!lines) return lines.error();
  CarmenParser parser(path, beam_count);
  Result<std::string_view> line = lines->next();
  for (; line; line = lines->next()) parser.parse_line(*line, lines->line_number());
  const bool damaged = line.error().code == ErrorCode::kDamaged;
  if (damaged) parser.add_problem(line.error().message);
  CarmenLog log = parser.finish();
  if (!log.scans.empty()) return log;
  if (damaged) return line.error();
  if (!log.problems.empty())
    return Error{ErrorCode::kInvalidInput, log.problems.front() + "; no usable scan"};
  return Error{
      ErrorCode::kInvalidInput,
      path +
          ": neither a capture (pcap) nor a table (.csv) nor a CARMEN laser log (no FLASER, ROBOTLASER1 "
          "or RAWLASER1 line)"};
}

}  // namespace swiftlet
