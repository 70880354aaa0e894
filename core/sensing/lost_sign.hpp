// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>
#include <span>
#include <vector>

#include "core/geometry/pose2.hpp"
#include "core/sensing/range_sample.hpp"
#include "core/sensing/sensor_model.hpp"

namespace swiftlet {

/// Costs, gains and evidence are negative log-likelihoods and their differences (nats).
struct LostSignTuning {
  double both_ways_m = 0.05;  ///< driven forward and in reverse, as reported, shows that signs are reported:
                              ///< one scan_spacing_m, beyond the noise of single steps
  double standstill_m_per_s = 0.3;     ///< the slower of the two steps beside a turning point is slower than
                                       ///< this: 3 m/s^2 over half a period of 0.2 s
  double standstill_spacing_m = 0.02;  ///< standstills with less way between them count once
  double scan_spacing_m = 0.05;        ///< half of sigma_m: scans closer together say the same again ...
  double scan_spacing_rad = 0.1;       ///< ... unless they look elsewhere
  double memory_m = 3.0;  ///< hits are compared with those of this way: one that drifts less than sigma_m
  std::size_t max_beams = 16;  ///< of a scan, evenly chosen: the cost grows with their square
  double sigma_m = 0.1;  ///< from a hit to the nearest earlier one: their spacing along a wall, and drift
  double outlier_cost = 2.0;    ///< of a hit at two sigma_m or more
  double begin_cost = 5.0;      ///< for a standstill to begin a stretch in reverse: one in 150 does
  double end_cost = 2.0;        ///< for one to end it: one in 7 does
  double stretch_doubt = 13.0;  ///< what a stretch must gain to speak for lost signs: hits fit the known
                                ///< ground behind better than the unknown ahead; where no sign can be lost
                                ///< (begun while driving fast) stretches gain 8 to 11 on average
  double most_gain = 26.0;      ///< that counts of one stretch: twice the doubt, as one stretch may be a slip
  double least_evidence = 30.0;   ///< beyond the doubts, so of three stretches at least
  std::size_t max_paths = 16;     ///< hypotheses kept: four standstills within memory_m
  std::size_t look_ahead = 4096;  ///< samples: 7 minutes at 10 Hz, 1.6 MB
};

/// Positions of samples stamped `since` and later, up to the next record: mended = offset + sign * reported.
struct MendedPositions {
  HostTime since{};
  double sign = 1.0;
  Point2 offset;
};
/// The reverse: the pose as the odometry reported it. `mended` in order of time; empty where nothing was.
[[nodiscard]] Pose2 as_reported(std::span<const MendedPositions> mended, HostTime stamp,
                                const Pose2& T_mended);

/// Mends odometry that reports every way as forward (wheel counters without a direction, firmware that takes
/// the absolute value): decides from the ranges, with look-ahead, over which stretches each step (x, y, yaw)
/// has to become (-x, -y, yaw). A hidden Markov model with two states, which may change near a
/// standstill only; each path through it has a map of its own (per-survivor processing, Raheli, Polydoros &
/// Tzou 1995). "As reported" wins unless the whole run says that signs are lost; odometry that goes both ways
/// refutes it.
class LostSign {
 public:
  explicit LostSign(const BeamLayout& beams, const LostSignTuning& tuning = {});

  /// Allocates.
  void add(const RangeSample& sample);
  /// No sample follows: those held back can be taken.
  void end() { ended_ = true; }
  /// The next sample, in the order in which they were added; nullopt while it is held back.
  std::optional<RangeSample> take();

  /// The way that was taken as reversed, among the samples taken so far.
  [[nodiscard]] double reversed_m() const { return reversed_m_; }
  [[nodiscard]] const std::vector<MendedPositions>& mended() const { return mended_; }
  /// For "signs are lost" against "as reported", so far.
  [[nodiscard]] double evidence() const;

 private:
  struct Scan {
    double path_m = 0.0;
    double yaw_rad = 0.0;
    std::vector<Point2> hits_odom;
  };
  struct Change {
    std::uint64_t sample = 0;  ///< the first with the other sign
    double lead_before = 0.0;  ///< by how much the path was better than "as reported"
  };
  /// One hypothesis on the signs so far.
  struct Path {
    double cost = 0.0;
    bool reversed = false;
    double changed_at_m = 0.0;        ///< the way at its last change
    Point2 offset;                    ///< mended less reported position, now ...
    std::deque<Point2> scan_offsets;  ///< ... and at each scan in memory
    std::vector<Change> changes{};    ///< begins and ends of stretches in reverse, in turn
  };

  LostSignTuning tuning_;
  std::array<Point2, kMaxBeams> direction_{};
  std::size_t beam_step_ = 1;

  std::deque<RangeSample> held_;
  std::uint64_t added_ = 0;
  std::uint64_t taken_ = 0;
  bool ended_ = false;
  bool refuted_ = false;

  // What is known of the motion.
  std::optional<RangeSample> newest_;
  double path_m_ = 0.0;
  double forward_m_ = 0.0;  ///< less what was reported as reverse: now, ...
  double least_forward_m_ = 0.0;
  double most_forward_m_ = 0.0;
  bool went_forward_ = false;
  bool went_backward_ = false;
  double speed_m_per_s_ = 0.0;
  double speed_before_m_per_s_ = 0.0;
  double standstill_at_m_ = 0.0;

  // The hypotheses and what they are judged by.
  std::deque<Scan> scans_;
  Path reported_;
  std::vector<Path> paths_{1};  // best first after each scan

  // What was taken.
  std::optional<Pose2> T_odom_taken_;
  double reversed_m_ = 0.0;
  std::vector<MendedPositions> mended_;

  void follow(const RangeSample& sample);
  void on_direction(double forward_m);
  void begin_segment(const RangeSample& sample);
  void on_speed(double speed_m_per_s);
  void branch();
  void judge(const RangeSample& sample);
  [[nodiscard]] Scan scan_of(const RangeSample& sample) const;
  [[nodiscard]] double cost_of(const Scan& scan, const Path& path) const;
  void prune();
  [[nodiscard]] const Path& best() const;
  [[nodiscard]] bool is_reversed(std::uint64_t sample) const;
  void mend(RangeSample& sample, bool reversed);
};

}  // namespace swiftlet
