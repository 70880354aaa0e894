// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "core/backend/refinement/local_moments.hpp"

#include <cstring>

namespace swiftlet {
namespace {

constexpr std::uint32_t kMaxWidth = 4;

/// Vectors of two or four numbers, by extensions of GCC and clang that compile for any machine.
using Pair = double __attribute__((vector_size(16)));
struct Twos {
  using Doubles = Pair;
  using Integers = std::int64_t __attribute__((vector_size(16)));
};
struct Fours {
  using Doubles = double __attribute__((vector_size(32)));
  using Integers = std::int64_t __attribute__((vector_size(32)));
};

/// Two moments in a vector, each summed point by point: the same bits whatever the width of the machine's
/// vectors.
[[gnu::always_inline]] inline void add_in_order(Pair& sum, const Pair& a, const Pair& b) {
  sum += __builtin_shufflevector(a, b, 0, 2);
  sum += __builtin_shufflevector(a, b, 1, 3);
}
[[gnu::always_inline]] inline void add_in_order(Pair& sum, const Fours::Doubles& a, const Fours::Doubles& b) {
  const Fours::Doubles even = __builtin_shufflevector(a, b, 0, 4, 2, 6);
  const Fours::Doubles odd = __builtin_shufflevector(a, b, 1, 5, 3, 7);
  sum += __builtin_shufflevector(even, even, 0, 1);
  sum += __builtin_shufflevector(odd, odd, 0, 1);
  sum += __builtin_shufflevector(even, even, 2, 3);
  sum += __builtin_shufflevector(odd, odd, 2, 3);
}

struct Query {
  double x_m, y_m;
  std::int64_t traversal;
  double radius_m2;
};

template <typename Vectors>
struct Sums {
  using Doubles = typename Vectors::Doubles;
  using Integers = typename Vectors::Integers;
  static constexpr std::uint32_t kWidth = sizeof(Doubles) / sizeof(double);
  Integers count{};
  Pair w_x{}, y_xx{}, xy_yy{};

  /// Adds the `kWidth` points from `first` on; those from `end` on have no weight.
  [[gnu::always_inline]] void add(const PointColumns& points, std::uint32_t first, std::uint32_t end,
                                  const Query& query) {
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
    add_in_order(w_x, weight, weight_dx);
    add_in_order(y_xx, weight_dy, weight_dx * dx);
    add_in_order(xy_yy, weight_dx * dy, weight_dy * dy);
  }
};

template <typename Vectors>
[[gnu::always_inline]] inline Moments2 moments(const PointColumns& points, std::span<const PointRange> ranges,
                                               const TraversalPoint& place, double radius_m) {
  const Query query{place.p_map.x_m, place.p_map.y_m, place.traversal, radius_m * radius_m};
  using S = Sums<Vectors>;
  S sums;
  for (const PointRange& range : ranges)
    for (std::uint32_t i = range.begin; i < range.end; i += S::kWidth) sums.add(points, i, range.end, query);
  std::int64_t count = 0;
  for (std::uint32_t i = 0; i < S::kWidth; ++i) count += sums.count[i];
  return {static_cast<std::size_t>(count),
          sums.w_x[0],
          sums.w_x[1],
          sums.y_xx[0],
          sums.y_xx[1],
          sums.xy_yy[0],
          sums.xy_yy[1]};
}

#if defined(__x86_64__) || defined(__i386__)
[[gnu::target("avx2")]] Moments2 moments_avx2(const PointColumns& points, std::span<const PointRange> ranges,
                                              const TraversalPoint& place, double radius_m) {
  return moments<Fours>(points, ranges, place, radius_m);
}
const bool kHasAvx2 = __builtin_cpu_supports("avx2");
#endif

}  // namespace

PointColumns::PointColumns(std::span<const TraversalPoint> points)
    : size_(points.size()),
      x_m_(size_ + kMaxWidth - 1),
      y_m_(size_ + kMaxWidth - 1),
      traversal_(size_ + kMaxWidth - 1) {
  for (std::size_t i = 0; i < size_; ++i) {
    x_m_[i] = points[i].p_map.x_m;
    y_m_[i] = points[i].p_map.y_m;
    traversal_[i] = points[i].traversal;
  }
}

Moments2 local_moments(const PointColumns& points, std::span<const PointRange> ranges,
                       const TraversalPoint& place, double radius_m) {
#if defined(__x86_64__) || defined(__i386__)
  if (kHasAvx2) return moments_avx2(points, ranges, place, radius_m);
#endif
  return local_moments_portable(points, ranges, place, radius_m);
}

Moments2 local_moments_portable(const PointColumns& points, std::span<const PointRange> ranges,
                                const TraversalPoint& place, double radius_m) {
  return moments<Twos>(points, ranges, place, radius_m);
}

}  // namespace swiftlet
