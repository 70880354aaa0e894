// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "core/base/fixed_vector.hpp"
#include "core/base/time.hpp"
#include "core/sensing/range_sample.hpp"
#include "core/sensing/sensor_model.hpp"
#include "core/sensing/storey_tracker.hpp"
#include "firmware_link/sample/input_counters.hpp"
#include "firmware_link/sample/learnt_period.hpp"
#include "firmware_link/sample/odometry_timeline.hpp"

namespace swiftlet {

/// The contents of one packet, or of one line of a log, in any format.
struct Reading {
  std::uint8_t stream = 0;  ///< log block, or kind of line: times ascend within a stream
  std::uint32_t boot = 0;   ///< of the vehicle: its clock and its dead reckoning restart with each
  DeviceTime at{};
  HostTime received{};
  std::optional<Point2> position_odom;
  std::optional<double> yaw_odom_rad;
  std::optional<BodyTilt> tilt;
  std::optional<double> height_m;    ///< above the ground below
  std::optional<double> altitude_m;  ///< by a barometer; only differences count
  std::optional<bool> is_flying;     ///< nullopt: the vehicle does not report it
  bool odometry_restarted = false;   ///< the dead reckoning has restarted
  /// One distance a beam, or empty: no ranges in this packet. NaN is no measurement; out-of-range values stay
  /// as they are.
  FixedVector<float, kMaxBeams> distance_m;
};

struct AssemblyConfig {
  BeamLayout beams;
  SensorModel sensor;
  Duration range_period{};  ///< nominal, to count gaps by; 0: irregular, gaps are not counted
  /// The sensors measure no more often. A packet that holds the distances of one that came less than this
  /// before holds the same measurement and makes no sample; 0: each packet holds a new one.
  Duration measurement_period{};
  ContinuityLimits continuity;
};

/// Assembles range samples from readings: pairs ranges with dead reckoning of the same instant (the packet's
/// time less the range's age), position and yaw each interpolated on its own time line, because they may come
/// in different packets. Waits for dead reckoning that is still to come, for a short time; keeps the order;
/// counts what it drops. Where packets come faster than the sensors measure, each measurement makes one
/// sample, at the first packet that holds it: more would draw it again at places where it was not taken.
/// Where tilt and height of that instant are known, too (they are waited for while they come often enough to
/// be interpolated), ranges become horizontal distances, and those that can be the floor's become invalid; by
/// the height alone, all that were measured from kStandingM or less, whatever the vehicle reports. Altitude
/// and height tell the storey. Fixed storage, no allocation, one thread at a time.
class SampleAssembler {
 public:
  /// Counts into `counters`, which must outlive the assembler.
  SampleAssembler(const AssemblyConfig& config, InputCounters& counters);

  /// The periods of ranges and dead reckoning; 0: not known, it is learnt from the next readings, and ranges
  /// in holes of the dead reckoning wait meanwhile. Dead reckoning is interpolated across 2.5 periods (one
  /// lost packet), but at least 250 ms, and at most 2.5 s where its period is learnt; tilt and height across
  /// 2.5 periods of the slower of dead reckoning and ranges, likewise at least 250 ms.
  void set_periods(Duration range_period, Duration odometry_period);
  /// A duplicate or late reading is dropped and counted; a step back of more than a second is a reboot of the
  /// vehicle.
  void add(const Reading& reading);
  /// No more readings will come: ranges that wait for dead reckoning are dropped.
  void end();
  /// The next finished sample, if any. Call until empty after each add().
  [[nodiscard]] std::optional<RangeSample> take();
  [[nodiscard]] const StoreyTracker& storeys() const { return storeys_; }

 private:
  struct PendingRanges {
    DeviceTime measured_at{};
    HostTime received{};
    FixedVector<float, kMaxBeams> distance_m;
  };
  /// Which runs of the dead reckoning a sample belongs to, how many pauses that had before, and when the
  /// sample was measured.
  struct Motion {
    std::uint32_t position_run = 0;
    std::uint32_t yaw_run = 0;
    std::uint32_t pauses = 0;
    DeviceTime at{};
  };

  /// False when the reading is a duplicate or late.
  bool accept_time(const Reading& reading);
  void restart();
  void follow_ground(const Reading& reading);
  void count_gap(const Reading& reading);
  void count_hole(Duration between_ranges);
  void interpolate_across(Duration odometry_period);
  void interpolate_attitude();
  void learn_periods(const Reading& reading);
  /// If enough readings have come for them, or no more can.
  void apply_learnt_periods();
  /// Whether no sensor has measured since the last ranges that were held.
  bool repeats_measurement(const Reading& reading);
  void hold_ranges(const Reading& reading);
  /// Of tilt or height at that time: a reading that is close enough comes with the next packets.
  template <typename Timeline>
  [[nodiscard]] bool is_coming(const Timeline& timeline, DeviceTime at) const;
  /// Whether motion joins it with the last sample.
  [[nodiscard]] bool is_of_last_run(const Motion& motion) const;
  /// Whether the step from the last sample is no guess. Precondition: is_of_last_run().
  [[nodiscard]] bool was_watched_until(const Motion& motion) const;
  /// False when the dead reckoning has run away.
  bool is_within_reach(const Point2& position_odom, const Motion& motion);
  RangeSample finish(const PendingRanges& ranges, const Pose2& T_odom_body, const Motion& motion);
  [[nodiscard]] bool stands_at(double height_m, const Point2& position_odom);
  void fill_beams(const PendingRanges& ranges, RangeSample& sample);
  void drop_oldest();

  AssemblyConfig config_;
  bool learns_range_period_ = false;
  bool learns_odometry_period_ = false;
  LearntPeriod range_times_;
  LearntPeriod position_times_;
  LearntPeriod yaw_times_;
  InputCounters& counters_;
  ContinuityLimits attitude_;  ///< of tilt and height
  OdometryTimeline<Point2> positions_;
  OdometryTimeline<YawReading> yaws_;
  OdometryTimeline<BodyTilt> tilts_;
  OdometryTimeline<HeightReading> heights_;
  struct MeasuredHeight {
    DeviceTime at{};
    double height_m = 0.0;
  };
  std::optional<MeasuredHeight> last_height_;  ///< nothing where it could not be measured
  StoreyTracker storeys_;
  /// 100 scans a second for 1.25 s: until dead reckoning comes, once a second, and by kMinRangeAge longer.
  FixedVector<PendingRanges, 128> pending_;
  std::array<std::optional<DeviceTime>, 256> last_by_stream_{};
  std::optional<DeviceTime> last_ranges_at_;  ///< since the last restart
  struct Measurement {
    DeviceTime first_at{};
    FixedVector<float, kMaxBeams> distance_m;
  };
  std::optional<Measurement> last_measurement_;  ///< likewise
  std::optional<HostTime> last_ranges_received_;
  std::uint32_t boot_ = 0;
  DeviceTime latest_{};  ///< of all readings since the last restart
  std::optional<Motion> last_motion_;
  std::optional<Point2> low_at_odom_;  ///< where it came down to kStandingM, if it is not above
  bool travelled_low_ = false;         ///< since then, farther than kCarriedM: nothing measures the height
  Point2 began_at_odom_;               ///< the dead reckoning, with the run of last_motion_
  std::uint32_t next_sequence_ = 0;
  bool ended_ = false;
};

/// The status of a distance, given the sensor's limits: below min_range_m and NaN kInvalid, max_range_m and
/// beyond kNoReturn. The firmware's sentinels fall out of the same rule: 0 mm is no measurement, 32766 mm no
/// target; firmware before 2022.09 reports distances beyond the sensor's reach instead.
[[nodiscard]] RangeStatus classify_distance(double distance_m, const SensorModel& sensor);

}  // namespace swiftlet
