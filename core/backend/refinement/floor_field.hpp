// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <span>
#include <tuple>
#include <vector>

#include "core/backend/config/backend_tuning.hpp"
#include "core/geometry/pose2.hpp"
#include "core/sensing/range_sample.hpp"

namespace swiftlet {

/// Where a node of the run lies.
struct PlaceOnFloor {
  Point2 p_map;
  StoreyId storey{};
};

/// By which factor a flow sensor errs, by place: over some floors it sees a part of the motion only, over the
/// same ones each time. One error per square cell of the floor is shared by all motions that cross it: a
/// motion is 1 + error times as long as measured. Most floors have none and some a great one, so the prior is
/// Cauchy's (Student's t with one degree of freedom). Allocates in place(). One thread at a time.
class FloorField {
 public:
  explicit FloorField(const FloorFieldTuning& tuning) : tuning_(tuning) {}

  /// Finds the cell of each motion, that from the node before to each node, in its middle; the first node has
  /// none. Cells keep their errors.
  void place(std::span<const PlaceOnFloor> nodes);
  /// Of the motion to a node; not the first.
  [[nodiscard]] std::size_t cell_of(std::size_t node) const { return cell_of_[node]; }
  [[nodiscard]] std::size_t size() const { return errors_.size(); }  ///< cells
  [[nodiscard]] double error(std::size_t cell) const { return errors_[cell]; }
  /// Of the prior, at the present error: that of the normal distribution with the same slope.
  [[nodiscard]] double information(std::size_t cell) const;
  void change(std::size_t cell, double by);
  /// What the prior asks for these errors in place of none, in log odds. At the optimum, the measurements
  /// have gained at least as much.
  [[nodiscard]] double cost() const;

 private:
  using Key = std::tuple<StoreyId, std::int32_t, std::int32_t>;  // storey, x and y in cells
  [[nodiscard]] Key key_between(const PlaceOnFloor& from, const PlaceOnFloor& to) const;

  FloorFieldTuning tuning_;
  std::map<Key, std::size_t> cells_;
  std::vector<double> errors_;        // by cell
  std::vector<std::size_t> cell_of_;  // by node
};

/// What a run shows of its floors.
struct FloorFindings {
  double cost = 0.0;               ///< FloorField::cost(); 0 where all are taken as even
  std::vector<double> step_scale;  ///< one per scan: how many times as long as reported the step to it is
};

}  // namespace swiftlet
