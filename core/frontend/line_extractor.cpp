// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "core/frontend/line_extractor.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace swiftlet {
namespace {

// From the chord a-b, or from a where the chord has no length.
double distance_from_chord_m(const Point2& p, const Point2& a, const Point2& b) {
  const double length_m = distance_m(a, b);
  if (length_m < 1e-3) return distance_m(p, a);
  return std::abs((b.x_m - a.x_m) * (p.y_m - a.y_m) - (b.y_m - a.y_m) * (p.x_m - a.x_m)) / length_m;
}

struct Extent {
  double low_m = std::numeric_limits<double>::infinity();
  double high_m = -std::numeric_limits<double>::infinity();
  void include(double t_m) {
    low_m = std::min(low_m, t_m);
    high_m = std::max(high_m, t_m);
  }
};

}  // namespace

LineExtractor::LineExtractor(const FrontendConfig& config, double range_sigma_m)
    : config_(config), range_variance_m2_(range_sigma_m * range_sigma_m) {}

std::size_t LineExtractor::extract(const MultiscanView& view, LineSegments& segments) {
  segments.clear();
  order_points(view);
  split(view);
  merge();
  std::size_t left_out = 0;
  for (const Piece& piece : pieces_) {
    if (piece.fit.count() < static_cast<std::size_t>(config_.min_line_points)) continue;
    if (distance_m(piece.end_a, piece.end_b) < config_.min_line_length_m) continue;
    if (piece.fit.rms_m() > config_.max_line_rms_m) continue;
    if (is_grazed(view, piece)) continue;
    if (!segments.try_push_back(segment_of(view, piece))) ++left_out;
  }
  return left_out;
}

// Beam by beam, each in the order of time: a beam sweeps along a wall as the vehicle moves, so its successive
// points lie side by side. Ordered by bearing, surfaces behind nearer ones, observed from older poses, would
// interleave. merge() joins the pieces of one wall from several beams.
void LineExtractor::order_points(const MultiscanView& view) {
  order_.clear();
  for (std::size_t i = 0; i < view.points.size(); ++i) {
    const bool has_room = order_.try_push_back(static_cast<std::uint16_t>(i));
    SWIFTLET_CHECK(has_room, "the order has room for a view's points");
  }
  std::sort(order_.begin(), order_.end(), [&view](std::uint16_t a, std::uint16_t b) {
    const std::uint8_t beam_a = view.points[a].beam;
    const std::uint8_t beam_b = view.points[b].beam;
    return beam_a != beam_b ? beam_a < beam_b : a < b;
  });
}

void LineExtractor::split(const MultiscanView& view) {
  pieces_.clear();
  label_.fill(kNoPiece);
  std::size_t first = 0;
  for (std::size_t i = 1; i <= order_.size(); ++i) {
    const bool run_ends = i == order_.size() ||
                          view.points[order_[i]].beam != view.points[order_[i - 1]].beam ||
                          distance_m(view.points[order_[i]].p_body, view.points[order_[i - 1]].p_body) >
                              config_.max_point_gap_m;
    if (!run_ends) continue;
    split_run(view, {first, i - 1});
    first = i;
  }
}

void LineExtractor::split_run(const MultiscanView& view, Range run) {
  waiting_.clear();
  bool has_room = waiting_.try_push_back(run);
  while (!waiting_.empty()) {
    const Range range = waiting_.back();
    waiting_.truncate(waiting_.size() - 1);
    const Point2& a = view.points[order_[range.first]].p_body;
    const Point2& b = view.points[order_[range.last]].p_body;
    double farthest_m = 0.0;
    std::size_t split_at = range.first;
    for (std::size_t i = range.first + 1; i < range.last; ++i) {
      const double d = distance_from_chord_m(view.points[order_[i]].p_body, a, b);
      if (d > farthest_m) {
        farthest_m = d;
        split_at = i;
      }
    }
    if (farthest_m <= config_.split_distance_m) {
      add_piece(view, range);
      continue;
    }
    has_room = waiting_.try_push_back({split_at, range.last}) &&
               waiting_.try_push_back({range.first, split_at - 1}) && has_room;
  }
  SWIFTLET_CHECK(has_room, "pieces of a run are fewer than its points");
}

void LineExtractor::add_piece(const MultiscanView& view, Range range) {
  if (range.last == range.first) return;
  Piece piece;
  piece.label = static_cast<std::uint16_t>(pieces_.size());
  for (std::size_t i = range.first; i <= range.last; ++i) {
    piece.fit.add(view.points[order_[i]].p_body);
    label_[order_[i]] = piece.label;
  }
  const Line2 line = piece.fit.line();
  Extent extent;
  for (std::size_t i = range.first; i <= range.last; ++i)
    extent.include(line.along_m(view.points[order_[i]].p_body));
  piece.end_a = line.point_at(extent.low_m);
  piece.end_b = line.point_at(extent.high_m);
  const bool has_room = pieces_.try_push_back(piece);
  SWIFTLET_CHECK(has_room, "pieces are fewer than points");
}

void LineExtractor::merge() {
  for (std::size_t i = 0; i < pieces_.size(); ++i) {
    for (std::size_t j = i + 1; j < pieces_.size();) {
      const std::uint16_t absorbed = pieces_[j].label;
      if (!try_merge(pieces_[i], pieces_[j])) {
        ++j;
        continue;
      }
      std::replace(label_.begin(), label_.end(), absorbed, pieces_[i].label);
      pieces_.erase(j);
      j = i + 1;  // a longer piece may reach what it could not before
    }
  }
}

bool LineExtractor::try_merge(Piece& into, const Piece& other) const {
  LineFit joint = into.fit;
  joint.add(other.fit);
  const Line2 line = joint.line();
  Extent a;
  Extent b;
  for (const Point2* end : std::array<const Point2*, 4>{&into.end_a, &into.end_b, &other.end_a, &other.end_b})
    if (std::abs(line.distance_m(*end)) >
        config_.tuning.lines.merge_distance_share * config_.split_distance_m)
      return false;
  a.include(line.along_m(into.end_a));
  a.include(line.along_m(into.end_b));
  b.include(line.along_m(other.end_a));
  b.include(line.along_m(other.end_b));
  if (std::max(a.low_m, b.low_m) - std::min(a.high_m, b.high_m) > config_.max_point_gap_m) return false;
  if (joint.rms_m() > config_.max_line_rms_m) return false;
  into.fit = joint;
  into.end_a = line.point_at(std::min(a.low_m, b.low_m));
  into.end_b = line.point_at(std::max(a.high_m, b.high_m));
  return true;
}

// A beam nearly parallel to its line observed something that moved along with it: a person, or an echo at the
// end of its range.
bool LineExtractor::is_grazed(const MultiscanView& view, const Piece& piece) const {
  const Line2 line = piece.fit.line();
  const double c = std::cos(line.alpha_rad);
  const double s = std::sin(line.alpha_rad);
  double sum = 0.0;
  for (std::size_t i = 0; i < view.points.size(); ++i)
    if (label_[i] == piece.label)
      sum += std::abs(c * view.points[i].direction.x_m + s * view.points[i].direction.y_m);
  return sum < std::sin(config_.min_incidence_rad) * static_cast<double>(piece.fit.count());
}

LineSegment LineExtractor::segment_of(const MultiscanView& view, const Piece& piece) const {
  LineSegment segment;
  segment.line = piece.fit.line();
  segment.covariance = covariance_of(view, piece, segment.line);
  Extent extent;
  extent.include(segment.line.along_m(piece.end_a));
  extent.include(segment.line.along_m(piece.end_b));
  segment.start = segment.line.point_at(extent.low_m);
  segment.end = segment.line.point_at(extent.high_m);
  return segment;
}

Eigen::Matrix2d LineExtractor::covariance_of(const MultiscanView& view, const Piece& piece,
                                             const Line2& line) const {
  Eigen::Matrix2d ranges = Eigen::Matrix2d::Zero();
  Eigen::Matrix2d motions = Eigen::Matrix2d::Zero();
  Eigen::Matrix<double, 2, 3> J_motion = Eigen::Matrix<double, 2, 3>::Zero();
  std::size_t next = 0;
  for (std::size_t scan = 0; scan < view.scans; ++scan) {
    for (; next < view.points.size() && view.points[next].scan == scan; ++next) {
      if (label_[next] != piece.label) continue;
      const MultiscanPoint& point = view.points[next];
      const Eigen::Matrix2d J = piece.fit.jacobian(line, point.p_body);
      const Eigen::Vector2d along_beam = J * Eigen::Vector2d(point.direction.x_m, point.direction.y_m);
      ranges += range_variance_m2_ * along_beam * along_beam.transpose();  // eqs. (15) and (18)
      J_motion.leftCols<2>() += J;
      J_motion.col(2) += J * Eigen::Vector2d(-point.p_body.y_m, point.p_body.x_m);
    }
    if (scan < view.motion_covariance.size())  // eqs. (16) and (17), of all points so far together
      motions += J_motion * view.motion_covariance[scan] * J_motion.transpose();
  }
  // A range that earlier multiscans used already is not new evidence.
  const double reuse =
      static_cast<double>(view.scans) / static_cast<double>(std::max<std::size_t>(view.new_scans, 1));
  Eigen::Matrix2d covariance = reuse * ranges + motions;
  covariance(0, 0) += config_.wall_sigma_m * config_.wall_sigma_m;
  covariance(1, 1) += config_.wall_sigma_rad * config_.wall_sigma_rad;
  return covariance;
}

}  // namespace swiftlet
