// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>
#include <vector>

#include "core/geometry/pose2.hpp"
#include "core/sensing/range_sample.hpp"
#include "core/sensing/sensor_model.hpp"

namespace swiftlet {

struct LostSignTuning {
  double backward_step_m = 0.001;
  double standstill_m_per_s = 0.3;
  double dip_travel_m = 0.02;
  double scan_spacing_m = 0.05;
  double scan_spacing_rad = 0.1;
  double memory_m = 3.0;
  std::size_t max_beams = 16;
  double sigma_m = 0.1;
  double cap = 2.0;
  double weight = 1.0;
  double to_reverse = 5.0;
  double to_forward = 2.0;
  double evidence = 30.0;
  std::size_t max_paths = 16;
  std::size_t look_ahead = 4096;
};

struct LostSignReport {
  double reversed_m = 0.0;
  std::size_t stretches = 0;
};

class LostSign {
 public:
  LostSign(const BeamLayout& beams, const LostSignTuning& tuning = {});
  void add(const RangeSample& sample);
  void end();
  std::optional<RangeSample> take();
  [[nodiscard]] const LostSignReport& report() const { return report_; }
  double evidence() const;

 private:
  struct Scan {
    double path_m;
    Pose2 T;
    std::vector<Point2> hits;
  };
  struct Path {
    double cost = 0.0;
    bool reversed = false;
    Point2 offset{};
    double switched_at_m = -1e9;
    std::deque<Point2> offsets;
    std::vector<std::uint64_t> switches;  // sample numbers
  };
  LostSignTuning tuning_;
  BeamLayout beams_;
  std::size_t beam_step_ = 1;
  bool refuted_ = false;
  bool ended_ = false;
  std::deque<RangeSample> held_;
  std::uint64_t first_held_ = 0;
  std::uint64_t next_ = 0;
  std::optional<RangeSample> last_;
  double speed_before_ = 0, speed_ = 0;
  double path_m_ = 0;
  double dip_at_m_ = -1;
  std::deque<Scan> scans_;
  std::vector<Path> paths_;  // [0]: as reported
  // output
  bool out_reversed_ = false;
  Point2 out_offset_{};
  std::optional<Pose2> T_out_before_;
  LostSignReport report_;

  void step(const RangeSample& sample);
  void branch();
  void score(const RangeSample& sample);
  void prune();
  RangeSample mend(RangeSample s);
  const Path& best() const;
};

}  // namespace swiftlet
