// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/geometry/pose2.hpp"

namespace swiftlet {

/// A return drawn in the map: where it lies and which traversal over the place it belongs to.
struct TraversalPoint {
  Point2 p_map;
  std::uint32_t traversal = 0;
};

/// Points by columns, for reading several at a time.
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
  std::vector<double> x_m_;  // padded: the last points too are read several at a time
  std::vector<double> y_m_;
  std::vector<std::int64_t> traversal_;
};

struct PointRange {
  std::uint32_t begin = 0;
  std::uint32_t end = 0;
};

/// Weighted moments of points around a place, relative to it.
struct LocalMoments {
  std::int64_t count = 0;
  double w = 0.0, x = 0.0, y = 0.0, xx = 0.0, xy = 0.0, yy = 0.0;
};

/// Of the points in `ranges` of other traversals than the place's and within the radius. The weight falls
/// from 1 at the place to 0 at the radius. With AVX2 where the machine has it. Does not allocate.
[[nodiscard]] LocalMoments local_moments(const PointColumns& points, std::span<const PointRange> ranges,
                                         const TraversalPoint& place, double radius_m);

/// The same to the last bit, with what every machine has.
[[nodiscard]] LocalMoments local_moments_portable(const PointColumns& points,
                                                  std::span<const PointRange> ranges,
                                                  const TraversalPoint& place, double radius_m);

}  // namespace swiftlet
