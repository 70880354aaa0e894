// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "core/backend/refinement/local_moments.hpp"

#include <cstring>

#include "core/base/processor.hpp"

namespace swiftlet {
namespace {

constexpr std::uint32_t kLanes = 4;

/// Vectors of two or four numbers, by extensions of GCC and clang that compile for any machine.
struct Twos {
  using Doubles = double __attribute__((vector_size(16)));
  using Integers = std::int64_t __attribute__((vector_size(16)));
};
struct Fours {
  using Doubles = double __attribute__((vector_size(32)));
  using Integers = std::int64_t __attribute__((vector_size(32)));
};

struct Query {
  double x_m, y_m;
  std::int64_t traversal;
  double radius_m2;
};

/// Four partial sums, one of every fourth point: the same bits whatever the width of the machine's vectors.
template <typename Vectors>
struct Lanes {
  using Vector = typename Vectors::Doubles;
  static constexpr std::uint32_t kWidth = sizeof(Vector) / sizeof(double);
  Vector parts[kLanes / kWidth]{};

  [[nodiscard]] double total() const { return (lane(0) + lane(1)) + (lane(2) + lane(3)); }
  [[nodiscard]] double lane(std::uint32_t i) const { return parts[i / kWidth][i % kWidth]; }
};

template <typename Vectors>
struct Sums {
  using Doubles = typename Vectors::Doubles;
  using Integers = typename Vectors::Integers;
  static constexpr std::uint32_t kWidth = Lanes<Vectors>::kWidth;
  Integers count{};
  Lanes<Vectors> w, x, y, xx, xy, yy;

  /// Adds four points from `first` on; those from `end` on have no weight.
  [[gnu::always_inline]] void add(const PointColumns& points, std::uint32_t first, std::uint32_t end,
                                  const Query& query) {
    for (std::uint32_t part = 0; part < kLanes / kWidth; ++part)
      add_part(points, part, first + part * kWidth, end, query);
  }
  [[gnu::always_inline]] void add_part(const PointColumns& points, std::uint32_t part, std::uint32_t first,
                                       std::uint32_t end, const Query& query) {
    Doubles dx, dy;
    Integers traversal;
    std::memcpy(&dx, points.x_m() + first, sizeof dx);
    std::memcpy(&dy, points.y_m() + first, sizeof dy);
    std::memcpy(&traversal, points.traversal() + first, sizeof traversal);
    dx -= query.x_m;
    dy -= query.y_m;
    const Doubles d2 = dx * dx + dy * dy;
    // A comparison that holds sets all bits.
    Integers counts = reinterpret_cast<Integers>(d2 < query.radius_m2) &
                      reinterpret_cast<Integers>(traversal != query.traversal);
    if (first + kWidth > end)
      for (std::uint32_t i = 0; i < kWidth; ++i) counts[i] = first + i < end ? counts[i] : 0;
    count -= counts;
    const Doubles closeness = 1.0 - d2 / query.radius_m2;
    const Doubles weight = reinterpret_cast<Doubles>(reinterpret_cast<Integers>(closeness) & counts);
    const Doubles weight_dx = weight * dx;
    const Doubles weight_dy = weight * dy;
    w.parts[part] += weight;
    x.parts[part] += weight_dx;
    y.parts[part] += weight_dy;
    xx.parts[part] += weight_dx * dx;
    xy.parts[part] += weight_dx * dy;
    yy.parts[part] += weight_dy * dy;
  }
};

template <typename Vectors>
[[gnu::always_inline]] inline Moments2 moments(const PointColumns& points, std::span<const PointRange> ranges,
                                               const TraversalPoint& place, double radius_m) {
  const Query query{place.p_map.x_m, place.p_map.y_m, place.traversal, radius_m * radius_m};
  Sums<Vectors> s;
  for (const PointRange& range : ranges)
    for (std::uint32_t i = range.begin; i < range.end; i += kLanes) s.add(points, i, range.end, query);
  std::int64_t count = 0;
  for (std::uint32_t i = 0; i < s.kWidth; ++i) count += s.count[i];
  return {static_cast<std::size_t>(count),
          s.w.total(),
          s.x.total(),
          s.y.total(),
          s.xx.total(),
          s.xy.total(),
          s.yy.total()};
}

#if SWIFTLET_MAY_HAVE_AVX2
[[gnu::target("avx2")]] Moments2 moments_avx2(const PointColumns& points, std::span<const PointRange> ranges,
                                              const TraversalPoint& place, double radius_m) {
  return moments<Fours>(points, ranges, place, radius_m);
}
#endif

}  // namespace

PointColumns::PointColumns(std::span<const TraversalPoint> points)
    : size_(points.size()),
      x_m_(size_ + kLanes - 1),
      y_m_(size_ + kLanes - 1),
      traversal_(size_ + kLanes - 1) {
  for (std::size_t i = 0; i < size_; ++i) {
    x_m_[i] = points[i].p_map.x_m;
    y_m_[i] = points[i].p_map.y_m;
    traversal_[i] = points[i].traversal;
  }
}

Moments2 local_moments(const PointColumns& points, std::span<const PointRange> ranges,
                       const TraversalPoint& place, double radius_m) {
#if SWIFTLET_MAY_HAVE_AVX2
  if (has_avx2()) return moments_avx2(points, ranges, place, radius_m);
#endif
  return local_moments_portable(points, ranges, place, radius_m);
}

Moments2 local_moments_portable(const PointColumns& points, std::span<const PointRange> ranges,
                                const TraversalPoint& place, double radius_m) {
  return moments<Twos>(points, ranges, place, radius_m);
}

}  // namespace swiftlet
