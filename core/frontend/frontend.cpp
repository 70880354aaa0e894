// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "core/frontend/frontend.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include "core/frontend/building_axis.hpp"
#include "core/frontend/chi_square.hpp"
#include "core/frontend/landmark_association.hpp"
#include "core/frontend/landmark_graph.hpp"
#include "core/frontend/landmark_graph_solver.hpp"
#include "core/frontend/line_extractor.hpp"
#include "core/frontend/odometry_drift.hpp"
#include "core/geometry/pose_residual.hpp"
#include "core/sensing/multiscan.hpp"
#include "core/sensing/odometry_covariance.hpp"

namespace swiftlet {
namespace {

constexpr LandmarkGraphCapacity kCapacity{kMaxKeyframeWindow, 128, 1024};
static_assert(kMaxLinesPerMultiscan <= kMaxLandmarksPerKeyframe);

}  // namespace

struct Frontend::State {
  State(const FrontendConfig& config_in, const SensorModel& sensor, const BeamLayout& beams)
      : config(config_in),
        odometry_noise(sensor.odometry),
        odometry_calibration(sensor.odometry_calibration),
        multiscan(sensor, beams, static_cast<std::size_t>(config.multiscan_points), config.tuning.multiscan),
        extractor(config, sensor.range_sigma_m),
        chi_square(config.chi_square_confidence),
        drift(sensor.odometry, config.tuning.drift),
        axis(config.tuning.axis) {}

  void track_motion(const RangeSample& sample);
  [[nodiscard]] bool keyframe_due(const RangeSample& sample) const;
  void add_keyframe_pose(const RangeSample& sample);
  void update_drift();
  void add_line_constraints();
  void insert(const LineSegment& segment);
  void align_newest_landmark();
  void update_axis();
  void optimize_or_roll_back();
  void report_keyframe(const RangeSample& sample);
  void report_landmarks(Keyframe& keyframe) const;

  FrontendConfig config;
  OdometryNoise odometry_noise;
  OdometryCalibration odometry_calibration;
  Multiscan multiscan;
  LineExtractor extractor;
  ChiSquareTable chi_square;
  OdometryDrift drift;
  BuildingAxis axis;
  LandmarkGraph<kCapacity> graph;
  LandmarkGraph<kCapacity>::Checkpoint before_batch;
  LandmarkGraphSolver<kCapacity> solver;
  MultiscanView view;
  LineSegments segments;

  std::optional<Pose2> T_odom_previous;
  DeviceTime previous_at{};
  UncertainMotion since_keyframe;
  double yaw_correction_rad = 0.0;                                          // of since_keyframe
  std::array<double, kMaxKeyframeWindow> yaw_correction_of_keyframe_rad{};  // by id, modulo the capacity
  std::array<bool, kMaxKeyframeWindow> sees_known_walls{};                  // likewise, in what was kept
  UncertainMotion keyframe_motion;                                 // from the keyframe before to the newest
  Eigen::Matrix3d viewpoint_covariance = Eigen::Matrix3d::Zero();  // of the newest keyframe, local frame
  KeyframeId newest{};
  StoreyId storey{};
  KeyframeId first_around{};  // of the segment and storey
  std::uint32_t next_landmark = 0;
  std::size_t associated = 0;      // observations of earlier landmarks in the present batch
  std::size_t aligned = 0;         // new landmarks in it with a prior on their direction
  double chi_square_before = 0.0;  // F without it
  FrontendCounters counters;
  FrontendStep step;
};

Frontend::Frontend(const FrontendConfig& config, const SensorModel& sensor, const BeamLayout& beams)
    : state_(std::make_unique<State>(config, sensor, beams)) {}
Frontend::~Frontend() = default;

const FrontendCounters& Frontend::counters() const noexcept { return state_->counters; }

// Algorithm 1; its lines in the comments.
const FrontendStep& Frontend::process(const RangeSample& sample, const Pose2& T_map_local) noexcept {
  State& s = *state_;
  ++s.counters.samples;
  s.track_motion(sample);
  s.step.has_keyframe = s.keyframe_due(sample);
  if (s.step.has_keyframe) {
    s.add_keyframe_pose(sample);  // line 1
    if (s.config.use_landmarks) {
      s.multiscan.assemble(s.view);                                        // line 2
      s.counters.refused_full += s.extractor.extract(s.view, s.segments);  // line 3
      s.graph.save(s.before_batch);                                        // line 7
      s.add_line_constraints();                                            // lines 4-6
      s.optimize_or_roll_back();                                           // lines 8-14
      if (s.config.align_to_walls) s.update_axis();
    }
    s.report_keyframe(sample);
  }
  s.step.sample = sample;
  s.step.keyframe = s.newest;
  s.step.T_keyframe_body = s.since_keyframe.T_from_to;
  s.step.T_local_body = s.graph.poses().back().T_local_body * s.since_keyframe.T_from_to;
  s.step.T_map_body = T_map_local * s.step.T_local_body;
  return s.step;
}

void Frontend::State::track_motion(const RangeSample& sample) {
  UncertainMotion motion;
  const bool is_elsewhere = sample.starts_segment || sample.storey != storey;
  if (is_elsewhere) multiscan.restart();
  if (T_odom_previous && (!sample.starts_segment || sample.odometry_ran_on)) {
    const Pose2 T_previous_body = odometry_calibration.corrected(
        between(*T_odom_previous, sample.T_odom_body), sample.measured_at - previous_at);
    const double correction_rad = drift.yaw_correction_rad(T_previous_body.x_m(), T_previous_body.yaw_rad());
    yaw_correction_rad += correction_rad;
    const Pose2 T_corrected(T_previous_body.x_m(), T_previous_body.y_m(),
                            T_previous_body.yaw_rad() + correction_rad);
    motion = sample.starts_segment
                 ? unwatched_step(odometry_noise, T_corrected, sample.measured_at - previous_at)
                 : uncertain_step(odometry_noise, T_corrected, sample.measured_at - previous_at);
    since_keyframe = since_keyframe * motion;
    step.T_dead_body = step.T_dead_body * motion.T_from_to;
  }
  T_odom_previous = sample.T_odom_body;
  previous_at = sample.measured_at;
  multiscan.add(sample, is_elsewhere ? UncertainMotion() : motion);
}

bool Frontend::State::keyframe_due(const RangeSample& sample) const {
  const Pose2& moved = since_keyframe.T_from_to;
  return sample.starts_segment || sample.storey != storey || graph.poses().empty() ||
         std::hypot(moved.x_m(), moved.y_m()) >= config.keyframe_distance_m ||
         std::abs(moved.yaw_rad()) >= config.keyframe_turn_rad;
}

void Frontend::State::add_keyframe_pose(const RangeSample& sample) {
  ++counters.keyframes;
  if (graph.poses().empty()) {
    keyframe_motion = {Pose2(), kUnknownMotion.covariance()};
    graph.add_first_pose(newest, Pose2());
  } else {
    ++newest;
    keyframe_motion = since_keyframe;
    // The storey may change on the spot; a motion without any error has no information matrix.
    if (keyframe_motion.covariance.isZero(0.0))
      keyframe_motion.covariance = odometry_sigma(odometry_noise, Pose2(), Duration::zero()).covariance();
    const Eigen::Matrix3d J = jacobian_compose_second(graph.poses().back().T_local_body);
    axis.turn(since_keyframe.covariance(2, 2));
    viewpoint_covariance = J * since_keyframe.covariance * J.transpose();
    // Landmarks of the segment or storey before are not associated in this one, nor do they tell its axis.
    if (sample.starts_segment || sample.storey != storey) first_around = newest;
    if (sample.starts_segment && !sample.odometry_ran_on) {
      // Odometry does not lead to the vehicle's new place: the estimate stays where it is.
      keyframe_motion.covariance = kUnknownMotion.covariance();
      viewpoint_covariance.setZero();
      axis = BuildingAxis(config.tuning.axis);
    }
    update_drift();
    if (graph.poses().size() == static_cast<std::size_t>(config.window_keyframes)) {
      counters.landmarks_retired += graph.marginalize_oldest_pose();
      ++counters.poses_retired;
    }
    const bool has_room = graph.try_add_pose(newest, keyframe_motion);
    SWIFTLET_CHECK(has_room, "the window is no longer than the graph's capacity");
  }
  yaw_correction_of_keyframe_rad[index_of(newest) % kMaxKeyframeWindow] =
      std::exchange(yaw_correction_rad, 0.0);
  since_keyframe = UncertainMotion();
  storey = sample.storey;
}

/// From a motion that later keyframes have corrected since; the correction already applied is part of the
/// error. A motion to where no known wall was seen is in the graph as it was predicted, and tells nothing.
void Frontend::State::update_drift() {
  const std::size_t lag = config.tuning.drift.lag_keyframes;
  if (graph.poses().size() < lag + 2) return;
  const PoseVertex& from = graph.poses()[graph.poses().size() - lag - 2];
  const PoseVertex& to = graph.poses()[graph.poses().size() - lag - 1];
  const std::size_t slot = index_of(to.id) % kMaxKeyframeWindow;
  if (!sees_known_walls[slot]) return;
  const double corrected_rad = yaw_correction_of_keyframe_rad[slot];
  const double yaw_error_rad =
      pose_residual(to.T_previous_body, from.T_local_body, to.T_local_body).error(2) + corrected_rad;
  drift.update(to.T_previous_body.x_m(), wrap_angle(to.T_previous_body.yaw_rad() - corrected_rad),
               yaw_error_rad, 1.0 / to.information(2, 2));
}

void Frontend::State::add_line_constraints() {
  associated = 0;
  aligned = 0;
  chi_square_before = graph.chi_square();
  counters.lines_extracted += segments.size();
  for (const LineSegment& segment : segments) insert(segment);
}

void Frontend::State::insert(const LineSegment& segment) {
  const auto lag = static_cast<std::uint32_t>(config.association_keyframes);
  const KeyframeId oldest = index_of(newest) > lag ? newest - lag : KeyframeId{};
  const Viewpoint viewpoint{graph.poses().back().T_local_body, viewpoint_covariance};
  const std::optional<std::size_t> known =
      associate(graph.landmarks(), segment, viewpoint, std::max(oldest, first_around), config);
  const bool has_room =
      known ? graph.try_observe(*known, segment) : graph.try_add_landmark(LandmarkId{next_landmark}, segment);
  if (!has_room) {
    ++counters.refused_full;
    return;
  }
  ++counters.observations_added;
  if (known) {
    ++associated;
  } else {
    ++next_landmark;
    ++counters.landmarks_created;
    if (config.align_to_walls) align_newest_landmark();
  }
}

void Frontend::State::align_newest_landmark() {
  const Landmark& newest_landmark = graph.landmarks().back();
  const auto prior =
      axis.direction_near(newest_landmark.line_local.alpha_rad, newest_landmark.covariance(1, 1));
  if (!prior) return;
  graph.add_direction_prior_to_newest(prior->yaw_rad, prior->information);
  ++aligned;
}

void Frontend::State::update_axis() {
  FixedVector<WallDirection, kCapacity.landmarks> walls;
  for (const Landmark& landmark : graph.landmarks()) {
    if (landmark.last_seen < first_around) continue;
    const bool has_room = walls.try_push_back(
        {landmark.line_local.alpha_rad, distance_m(landmark.start_local, landmark.end_local)});
    SWIFTLET_CHECK(has_room, "the list has room for all landmarks of a graph");
  }
  axis.update(std::span(walls.begin(), walls.size()));
}

// Eq. (19) on the increase of F by the batch: its degrees of freedom are the observations of earlier
// landmarks and the direction priors of new ones. On F as a whole, as in the paper, one bad batch is hidden
// by many good ones and then makes the next one worse.
void Frontend::State::optimize_or_roll_back() {
  bool& sees_known = sees_known_walls[index_of(newest) % kMaxKeyframeWindow];
  sees_known = associated > 0;
  step.made.innovation = 0.0;
  step.made.innovation_dof = sees_known ? static_cast<std::uint32_t>(2 * associated + aligned) : 0U;
  if (associated + aligned > 0) {
    const double increase =
        solver.optimize(graph, config.solver_iterations, config.tuning.solver).chi_square - chi_square_before;
    if (sees_known) step.made.innovation = std::max(0.0, increase);
    if (increase > chi_square.quantile(2 * associated + aligned)) {
      graph.restore(before_batch);
      ++counters.batches_rolled_back;
      sees_known = false;
    }
  }
  graph.update_end_points();
}

void Frontend::State::report_keyframe(const RangeSample& sample) {
  Keyframe& made = step.made;
  made.id = newest;
  made.motion_covariance = Covariance3::from_matrix(keyframe_motion.covariance);
  made.starts_segment = sample.starts_segment || counters.keyframes == 1;
  made.odometry_ran_on = sample.odometry_ran_on && counters.keyframes > 1;
  made.T_local_keyframe.clear();
  for (const PoseVertex& pose : graph.poses()) {
    const bool has_room = made.T_local_keyframe.try_push_back(pose.T_local_body);
    SWIFTLET_CHECK(has_room, "a keyframe has room for the poses of a window");
  }
  made.landmarks.clear();
  if (config.use_landmarks) report_landmarks(made);
}

void Frontend::State::report_landmarks(Keyframe& keyframe) const {
  const Pose2 T_body_local = graph.poses().back().T_local_body.inverse();
  for (const Landmark& landmark : graph.landmarks()) {
    if (landmark.last_seen != newest) continue;
    const LandmarkUpdate update{landmark.id, T_body_local * landmark.start_local,
                                T_body_local * landmark.end_local};
    const bool has_room = keyframe.landmarks.try_push_back(update);
    SWIFTLET_CHECK(has_room, "a keyframe has room for the lines of a multiscan");
  }
}

}  // namespace swiftlet
