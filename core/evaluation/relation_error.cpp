// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "core/evaluation/relation_error.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <utility>
#include <vector>

namespace swiftlet {
namespace {

Spread spread_of(std::span<const double> values) {
  Spread spread;
  if (values.empty()) return spread;
  const auto count = static_cast<double>(values.size());
  for (const double value : values) spread.mean += value;
  spread.mean /= count;
  double sum_of_squares = 0.0;
  for (const double value : values) sum_of_squares += (value - spread.mean) * (value - spread.mean);
  spread.deviation = std::sqrt(sum_of_squares / count);
  spread.max = *std::max_element(values.begin(), values.end());
  return spread;
}

class MotionErrors {
 public:
  void add(double translation_m, double rotation_deg) {
    translation_m_.push_back(translation_m);
    rotation_deg_.push_back(rotation_deg);
  }
  [[nodiscard]] MotionError summary() const {
    return {translation_m_.size(), spread_of(translation_m_), spread_of(rotation_deg_)};
  }

 private:
  std::vector<double> translation_m_;
  std::vector<double> rotation_deg_;
};

}  // namespace

RelationError relation_error(std::span<const Relation> relations, const StampedPath& path) {
  RelationError error;
  MotionErrors all;
  MotionErrors short_ones;
  MotionErrors middling;
  MotionErrors long_ones;
  std::vector<HostTime> stamps;
  for (const Relation& relation : relations) {
    stamps.insert(stamps.end(), {relation.first, relation.second});
    const StampedPose* first = path.nearest(relation.first);
    const StampedPose* second = path.nearest(relation.second);
    if (first == nullptr || second == nullptr) {
      ++error.missed;
      error.each_translation_m.emplace_back();
      continue;
    }
    const Pose2 off = between(relation.T_first_second, between(first->pose, second->pose));
    const Duration span = std::chrono::abs(relation.second - relation.first);
    const bool is_short = span < std::chrono::seconds(3);
    const double translation_m = std::hypot(off.x_m(), off.y_m());
    error.each_translation_m.emplace_back(translation_m);
    MotionErrors& by_span = is_short ? short_ones : span < std::chrono::seconds(100) ? middling : long_ones;
    for (MotionErrors* errors : {&all, &by_span})
      errors->add(translation_m, degrees(std::abs(off.yaw_rad())));
  }
  error.all = all.summary();
  error.under_3_s = short_ones.summary();
  error.from_3_to_100_s = middling.summary();
  error.over_100_s = long_ones.summary();
  error.stamps = match_stamps(std::move(stamps), path);
  return error;
}

}  // namespace swiftlet
