// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <Eigen/Core>

#include <array>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "core/geometry/pose2.hpp"
#include "core/sensing/mended_odometry.hpp"
#include "core/sensing/range_sample.hpp"
#include "core/sensing/sensor_model.hpp"

namespace swiftlet {

/// Costs and gains are negative log-likelihoods and their differences (nats).
struct LostSignTuning {
  double both_ways_m = 0.05;  ///< driven forward and in reverse, as reported, shows that signs are reported:
                              ///< beyond the noise of single steps
  double standstill_m_per_s = 0.3;     ///< the slower of the two steps beside a turning point is slower than
                                       ///< this: 3 m/s^2 over half a period of 0.2 s
  double standstill_spacing_m = 0.02;  ///< standstills with less way between them count once
  double scan_spacing_m = 0.05;        ///< half of sigma_m: scans closer together add nothing ...
  double scan_spacing_rad = 0.1;       ///< ... unless they look elsewhere
  double memory_m = 3.0;  ///< a scan is compared with those of this way: dead reckoning drifts less than
                          ///< sigma_m over it
  double sigma_m = 0.1;   ///< from a hit to the nearest earlier one: their spacing along a wall, and drift
  double outlier_cost = 2.0;  ///< of a hit at two sigma_m or more, and of one that contradicts an earlier ray
  double begin_cost = 5.0;    ///< for a standstill to begin a stretch with the other sign: one in 150 does
  double end_cost = 2.0;      ///< for one to end it: one in 7 does
  double beside_m = 0.05;     ///< a ray passes through all that lies nearer to it than half of sigma_m ...
  double before_m = 0.3;      ///< ... and farther before its end than three sigma_m
  double scan_weight = 4.0;   ///< rays of a scan err together: more than these don't add to the gain
  double stretch_doubt = 10.0;  ///< what a stretch gains by slips and lags alone: 9 on most laser logs; one
                                ///< that gains no more is taken as reported
  double max_gain = 30.0;       ///< that counts of one stretch; paths that lag by more are given up ...
  double min_evidence = 50.0;   ///< ... so that one or two are no evidence, unless ...
  double clear_gain = std::numeric_limits<double>::infinity();  ///< ... one gains that much
  std::size_t max_paths = 8;      ///< hypotheses kept: three standstills within memory_m
  std::size_t look_ahead = 4096;  ///< samples: 7 minutes at 10 Hz, 1.6 MB

  /// One clear stretch is enough: for who holds a map of the mended signs against one of those reported. No
  /// stretch of a laser log that loses no sign gains more than 62. Of 14 simulated flights that lose some, 13
  /// have one that gains 95 and more.
  [[nodiscard]] static LostSignTuning for_a_trial() {
    LostSignTuning tuning;
    tuning.clear_gain = 80.0;
    return tuning;
  }
};

/// What these changes of sign cost beforehand, nats: a map made with them has to explain that much more than
/// one without.
[[nodiscard]] double prior_cost(std::span<const MendedOdometry> mended, const LostSignTuning& tuning = {});

/// Mends odometry that reports every way as forward (wheel counters without a direction, firmware that takes
/// the absolute value): decides from the ranges, with look-ahead, over which stretches the part of each step
/// along the vehicle's heading is taken the other way round; what went sideways and how it turned stays. A
/// hidden Markov model with two states, which may change only near a standstill and where a segment begins;
/// each path through it has a map of its own (per-survivor processing, Raheli, Polydoros & Tzou 1995). A path
/// is chosen by how near its hits lie to earlier ones. It is judged by independent measures, since the choice
/// itself favours it: rays that pass through what others hit, and ranges that jump. "As reported" wins unless
/// the whole run shows that signs are lost; odometry that goes both ways refutes it.
class LostSign {
 public:
  LostSign(const SensorModel& sensor, const BeamLayout& beams, const LostSignTuning& tuning = {});

  /// Allocates.
  void add(const RangeSample& sample);
  /// No sample follows: those still buffered can be taken.
  void end() { ended_ = true; }
  /// The next sample, in the order in which they were added; nullopt while it is buffered.
  std::optional<RangeSample> take();

  /// The way that was taken as reversed, among the samples taken so far.
  [[nodiscard]] double reversed_m() const { return reversed_m_; }
  [[nodiscard]] const std::vector<MendedOdometry>& mended() const { return mended_; }
  /// For "signs are lost" against "as reported", so far, of all stretches together.
  [[nodiscard]] double evidence() const;

 private:
  static constexpr std::size_t kMaxRays = 16;  // of a scan, evenly chosen: time grows with their square
  static constexpr float kNowhereM = 1e6F;
  /// A figure of each ray of a scan.
  using Lanes = Eigen::Array<float, kMaxRays, 1>;
  template <typename Values>
  struct Planar {
    Values x;
    Values y;
  };
  /// Seen from where it was taken, along the odometry's axes. Rays without information pass through nothing,
  /// and what is no hit lies where nothing comes near.
  struct Scan {
    double path_m = 0.0;
    double yaw_rad = 0.0;
    Point2 from;
    Eigen::Array<RangeStatus, kMaxRays, 1> status =
        Eigen::Array<RangeStatus, kMaxRays, 1>::Constant(RangeStatus::kInvalid);
    Lanes length_m = Lanes::Zero();
    Planar<Lanes> direction{Lanes::Zero(), Lanes::Zero()};
    Lanes reach_m = Lanes::Constant(-1.0F);  ///< so far it passes through what lies beside it
    Planar<Lanes> hit_m{Lanes::Constant(kNowhereM), Lanes::Constant(kNowhereM)};
  };
  struct Cost {
    double misfit = 0.0;         ///< chooses
    double contradiction = 0.0;  ///< judges
  };
  struct Change {
    std::uint64_t sample = 0;    ///< the first with the other sign
    double margin_before = 0.0;  ///< by how much less the path contradicted itself than "as reported"
  };
  /// One hypothesis on the signs so far.
  struct Path {
    Cost cost;
    bool reversed = false;
    double changed_at_m = 0.0;        ///< the way at its last change
    Point2 offset;                    ///< mended less reported position, now ...
    std::deque<Point2> scan_offsets;  ///< ... and at each scan in memory
    std::vector<Change> changes{};    ///< begins and ends of stretches in reverse, in turn
  };
  /// An earlier scan for some of the paths.
  struct View {
    const Scan* earlier = nullptr;
    Point2 from;              ///< where the scan was taken that looks back, seen from there
    std::uint64_t paths = 0;  ///< a bit each
  };
  /// Of a ray with earlier ones.
  struct Encounter {
    double nearest2_m2 = 0.0;  ///< to the nearest hit, squared
    bool contradicts = false;
  };

  LostSignTuning tuning_;
  double variance2_m2_;
  double max_range_m_;
  std::array<Point2, kMaxBeams> direction_{};
  std::size_t beam_step_;
  Eigen::Index rays_;

  std::deque<RangeSample> held_;
  std::uint64_t added_ = 0;
  std::uint64_t taken_ = 0;
  bool ended_ = false;
  bool refuted_ = false;

  // What is known of the motion.
  std::optional<RangeSample> newest_;
  double path_m_ = 0.0;
  double forward_m_ = 0.0;  ///< less what was reported as reverse: now, ...
  double min_forward_m_ = 0.0;
  double max_forward_m_ = 0.0;
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
  Point2 offset_;  // mended less reported position
  std::vector<MendedOdometry> mended_;

  template <typename Visitor>
  void for_each_path(Visitor visit) {
    visit(reported_);
    for (Path& path : paths_) visit(path);
  }
  void follow(const RangeSample& sample);
  void on_direction(double forward_m);
  void begin_segment(const RangeSample& sample);
  void on_speed(double speed_m_per_s);
  /// From `sample` on the sign may be the other.
  void branch(std::uint64_t sample);
  void judge(const RangeSample& sample);
  [[nodiscard]] Scan scan_of(const RangeSample& sample) const;
  void add_costs(const Scan& scan);
  void add_costs(const Scan& scan, std::span<Path* const> paths) const;
  [[nodiscard]] std::vector<View> views_of(const Scan& scan, std::span<Path* const> paths) const;
  void meet(const Scan& scan, Eigen::Index ray, const std::vector<View>& views,
            std::vector<Encounter>& met) const;
  [[nodiscard]] Encounter encounter(const Scan& scan, Eigen::Index ray, const View& view, bool is_open) const;
  template <typename Rays, typename Hits>
  [[nodiscard]] Lanes outside(const Planar<Rays>& direction, const Rays& reach_m,
                              const Planar<Hits>& hits) const;
  [[nodiscard]] double jump_cost(const Scan& scan, Eigen::Index ray) const;
  [[nodiscard]] bool is_settled(const Path& path) const;
  void prune();
  [[nodiscard]] const Path& best() const;
  [[nodiscard]] double gain(const Path& path, std::size_t begin) const;
  [[nodiscard]] bool are_lost() const;
  [[nodiscard]] bool is_reversed(std::uint64_t sample) const;
  void mend(RangeSample& sample, bool reversed);
};

}  // namespace swiftlet
