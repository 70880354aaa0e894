// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>

#include "core/base/fixed_vector.hpp"
#include "core/frontend/frontend_config.hpp"
#include "core/frontend/line_fit.hpp"
#include "core/geometry/line2.hpp"
#include "core/sensing/multiscan.hpp"

namespace swiftlet {

/// Most lines that one multiscan yields; further ones are counted and left out.
inline constexpr std::size_t kMaxLinesPerMultiscan = 32;

/// A line as observed now, in the frame of the multiscan.
struct LineSegment {
  Line2 line;
  Eigen::Matrix2d covariance = Eigen::Matrix2d::Identity();  ///< of (rho, alpha): m^2, m rad, rad^2
  Point2 start;  ///< on the line; end lies counter-clockwise of it: along_m(start) < along_m(end)
  Point2 end;
};
using LineSegments = FixedVector<LineSegment, kMaxLinesPerMultiscan>;

/// Split-and-merge on the points of a multiscan (Nguyen et al., "A comparison of line extraction algorithms
/// using 2D laser rangefinder for indoor mobile robotics", IROS 2005). The points are split beam by beam in
/// the order of time, as one beam sweeps along a wall while the vehicle moves, then merged across beams; this
/// serves four beams with thirty scans and sixty beams with two. The covariance of a line is
/// eqs. (15)-(18) of "Efficient 2D Graph SLAM for Sparse Sensing" (IROS 2022), with the error of each motion
/// common to all points observed before it, less weight for ranges that an earlier multiscan used, and a
/// share for walls that are not ideal lines.
/// @note Fixed storage. One thread at a time.
class LineExtractor {
 public:
  LineExtractor(const FrontendConfig& config, double range_sigma_m);

  /// Replaces `segments` by the lines in the view, in a fixed order. Returns the number of lines without
  /// room.
  std::size_t extract(const MultiscanView& view, LineSegments& segments);

 private:
  static constexpr std::uint16_t kNoPiece = kMaxMultiscanPoints;
  // A piece of a line while splitting and merging: all points with its label.
  struct Piece {
    LineFit fit;
    Point2 end_a;
    Point2 end_b;
    std::uint16_t label = 0;
  };
  struct Range {
    std::size_t first = 0;
    std::size_t last = 0;
  };

  void order_points(const MultiscanView& view);
  void split(const MultiscanView& view);
  void split_run(const MultiscanView& view, Range run);
  void add_piece(const MultiscanView& view, Range range);
  void merge();
  [[nodiscard]] bool try_merge(Piece& into, const Piece& other) const;
  [[nodiscard]] bool is_grazed(const MultiscanView& view, const Piece& piece) const;
  [[nodiscard]] LineSegment segment_of(const MultiscanView& view, const Piece& piece) const;
  [[nodiscard]] Eigen::Matrix2d covariance_of(const MultiscanView& view, const Piece& piece,
                                              const Line2& line) const;

  FrontendConfig config_;
  double range_variance_m2_;
  FixedVector<std::uint16_t, kMaxMultiscanPoints> order_;
  FixedVector<Range, kMaxMultiscanPoints> waiting_;  // to be split further
  FixedVector<Piece, kMaxMultiscanPoints> pieces_;
  std::array<std::uint16_t, kMaxMultiscanPoints> label_{};  // of each point; merged pieces share one
};

}  // namespace swiftlet
