// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/result.hpp"
#include "core/base/time.hpp"
#include "core/geometry/pose2.hpp"
#include "core/sensing/sensor_model.hpp"
#include "firmware_link/laser_log/pose_scan_lag.hpp"

namespace swiftlet {

/// Dead reckoning of a robot in a CARMEN log, in the log's odometry frame.
struct CarmenOdometry {
  HostTime stamp{};  ///< ipc_timestamp
  Point2 position;
  double yaw_rad = 0.0;
  bool is_zero = false;    ///< as logged, all three numbers of the robot's pose
  std::uint64_t line = 0;  ///< of the file; of scans only
};

/// A laser log of the CARMEN toolkit, thinned to a few beams: the ODOM lines and those of one kind of scan,
///
///     FLASER n r_1 .. r_n x y theta odom_x odom_y odom_theta ipc_timestamp host logger_timestamp
///     ROBOTLASER1 SCAN laser_x laser_y laser_theta x y theta tv rv front side axis ipc_timestamp host ..
///     RAWLASER1 SCAN ipc_timestamp host logger_timestamp
///     ODOM x y theta tv rv accel ipc_timestamp host logger_timestamp
///
/// where SCAN is: type start_angle field_of_view step max_range accuracy remission_mode n r_1 .. r_n m s_1 ..
/// s_m. A log that has several kinds tells of the same scans in each: the first of this list counts.
///
/// The body is at the laser, with the robot's heading, as far as the log says where on the robot the laser
/// is: ROBOTLASER1 always does, FLASER where its first pose has the same place on the robot in all lines but
/// those whose poses are all zero, before the base has reported. Elsewhere that pose is another program's
/// estimate and is not used.
///
/// Scans and odometry are in the order of their stamps, lines with equal stamps in the order of the file.
struct CarmenLog {
  BeamLayout beams;
  const char* scan_line = "";            ///< the kind: "FLASER"
  double max_range_m = 0.0;              ///< of the scanner, as logged; 0: not said
  bool scans_have_poses = true;          ///< RAWLASER1 lines have none
  std::vector<CarmenOdometry> scans;     ///< stamp of each scan and the odometry in its line (odom_*)
  std::vector<float> distances_m;        ///< beams.count a scan, as logged
  std::vector<CarmenOdometry> odometry;  ///< of the ODOM lines
  std::uint64_t odometry_reversals =
      0;  ///< ODOM lines with a stamp before that of the line before, in file order
  std::uint64_t scan_reversals = 0;   ///< the same of scans
  Duration longest_step_back{};       ///< of these
  std::uint64_t duplicate_scans = 0;  ///< same stamp, same distances: dropped
  PoseScanLag pose_scan_lag;          ///< of the odometry in scans' lines, from all their readings
  std::uint64_t lines = 0;
  std::vector<std::string> problems;  ///< malformed lines and damage, by line number or byte offset

  [[nodiscard]] std::span<const float> distances_of(std::size_t scan) const {
    return std::span(distances_m).subspan(scan * beams.count, beams.count);
  }
};

/// Reads a whole log, plain or gzip. FLASER lines lie as usual_geometry() has it; the others say how theirs
/// lie. The first line of the kind that is used decides where the beams are; where later readings lie
/// otherwise, the nearest ones count, and a scan that lacks half of them or more is left out. Other lines
/// are ignored. Errors: kNotFound, kInvalidInput: no such log; kDamaged: damaged before the first scan.
/// Precondition: 2 <= beam_count <= kMaxBeams.
[[nodiscard]] Result<CarmenLog> read_carmen_log(const std::string& path, std::size_t beam_count);

}  // namespace swiftlet
