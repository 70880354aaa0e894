// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/geometry/moments2.hpp"
#include "core/geometry/pose2.hpp"

namespace swiftlet {

/// A return in the map, with the traversal that it belongs to.
struct TraversalPoint {
  Point2 p_map;
  std::uint32_t traversal = 0;
};

/// Points by columns, so that several are loaded at a time.
class PointColumns {
 public:
  PointColumns() = default;
  explicit PointColumns(std::span<const TraversalPoint> points);

  [[nodiscard]] std::size_t size() const { return size_; }
  [[nodiscard]] const double* x_m() const { return x_m_.data(); }
  [[nodiscard]] const double* y_m() const { return y_m_.data(); }
  [[nodiscard]] const std::int64_t* traversal() const { return traversal_.data(); }

 private:
  std::size_t size_ = 0;
  std::vector<double> x_m_;  // padded: a load of several points may reach past the last
  std::vector<double> y_m_;
  std::vector<std::int64_t> traversal_;
};

struct PointRange {
  std::uint32_t begin = 0;
  std::uint32_t end = 0;
};

/// Moments, relative to the place, of the points in `ranges` that lie within the radius and belong to other
/// traversals than the place's. The weight falls from 1 at the place to 0 at the radius. Uses AVX2 where the
/// machine has it. Does not allocate.
[[nodiscard]] Moments2 local_moments(const PointColumns& points, std::span<const PointRange> ranges,
                                     const TraversalPoint& place, double radius_m);

/// The same to the last bit on any machine.
[[nodiscard]] Moments2 local_moments_portable(const PointColumns& points, std::span<const PointRange> ranges,
                                              const TraversalPoint& place, double radius_m);

}  // namespace swiftlet
