// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <cstddef>

#include "core/base/tuning.hpp"
#include "core/geometry/angle.hpp"
#include "core/sensing/wall_axis.hpp"

namespace swiftlet {

struct SubmapTuning {
  double max_evidence = 3.5;  ///< log-odds of a cell at most: p of 0.03 and 0.97, yet it can still change
  double start_share = 0.5;   ///< of its length: there the next begins, so that no place lies only on a seam

  static constexpr TuningValue<SubmapTuning> kValues[] = {{"max_evidence", &SubmapTuning::max_evidence},
                                                          {"start_share", &SubmapTuning::start_share}};
};

struct LoopDetectorTuning {
  double search_sigmas = 3.0;         ///< the search reaches so many standard deviations, and at least ...
  double min_search_radius_m = 0.5;   ///< ... this far to either side ...
  double min_search_angle_rad = 0.1;  ///< ... and turned by this: covariances of motion are models, and dead
                                      ///< reckoning drifts by less from one query to the next
  double newer_query_m = 4.0;    ///< this much of the recent travel is matched where the window reaches no
                                 ///< farther: the next stretch as long begins just beyond it
  double thinning_cell_m = 0.1;  ///< of the hits that are matched, one per cell
  std::size_t max_closures = 3;  ///< of one query: in laps each overlaps all before, which fills the graph

  static constexpr TuningValue<LoopDetectorTuning> kValues[] = {
      {"search_sigmas", &LoopDetectorTuning::search_sigmas},
      {"min_search_radius_m", &LoopDetectorTuning::min_search_radius_m},
      {"min_search_angle_rad", &LoopDetectorTuning::min_search_angle_rad},
      {"newer_query_m", &LoopDetectorTuning::newer_query_m},
      {"thinning_cell_m", &LoopDetectorTuning::thinning_cell_m},
      {"max_closures", &LoopDetectorTuning::max_closures}};
};

struct CorrelativeMatcherTuning {
  double edge_penalty = 0.02;  ///< of the score at the window's edge: below any real difference, settles ties
  double likelihood_per_score = 60.0;  ///< log-likelihood of a pose (Olson 2009, section IV.D)
  double floor_sigma_m = 0.05;  ///< no match on these grids is better, whatever the scores say; nor is the
                                ///< published pose
  double floor_sigma_yaw_rad = 0.015;  ///< likewise
  double min_spread_m = 1.0;           ///< around the optimum the scores are evaluated as far as the window
  double max_spread_m = 4.0;           ///< reaches, within these bounds
  int yaw_spread_steps = 4;            ///< either way
  double min_known_share = 0.6;  ///< of the points on ground that the submap knows, or there is no match: one
                                 ///< wall of a corridor on the other would score better than both in place
  double edge_of_window = 0.95;  ///< share beyond which an optimum is none: walls draw it along a corridor
  double min_information = 1e-4;  ///< 1/m^2, left of a direction that only the submap's extent decided

  static constexpr TuningValue<CorrelativeMatcherTuning> kValues[] = {
      {"edge_penalty", &CorrelativeMatcherTuning::edge_penalty},
      {"likelihood_per_score", &CorrelativeMatcherTuning::likelihood_per_score},
      {"floor_sigma_m", &CorrelativeMatcherTuning::floor_sigma_m},
      {"floor_sigma_yaw_rad", &CorrelativeMatcherTuning::floor_sigma_yaw_rad},
      {"min_spread_m", &CorrelativeMatcherTuning::min_spread_m},
      {"max_spread_m", &CorrelativeMatcherTuning::max_spread_m},
      {"yaw_spread_steps", &CorrelativeMatcherTuning::yaw_spread_steps},
      {"min_known_share", &CorrelativeMatcherTuning::min_known_share},
      {"edge_of_window", &CorrelativeMatcherTuning::edge_of_window},
      {"min_information", &CorrelativeMatcherTuning::min_information}};
};

struct CrossCheckTuning {
  std::size_t min_seen_hits = 20;   ///< of the submap; fewer verify nothing
  double min_share_on_walls = 0.6;  ///< right matches seldom have less, false ones in wide windows mostly do
  int kernel_cells = 3;  ///< two visits draw a wall within a cell of each other; more hides free space

  static constexpr TuningValue<CrossCheckTuning> kValues[] = {
      {"min_seen_hits", &CrossCheckTuning::min_seen_hits},
      {"min_share_on_walls", &CrossCheckTuning::min_share_on_walls},
      {"kernel_cells", &CrossCheckTuning::kernel_cells}};
};

struct PlaceHypothesesTuning {
  double way_between_m = 2.0;           ///< travel between queries
  std::size_t max_queries = 20;         ///< older ones are forgotten: 40 m
  std::size_t max_hypotheses = 40;      ///< hypotheses
  double not_moved_odds = 1e6;          ///< to one: that it was not carried; known ground refutes it soon
  double unmoved_reach_m = 2.0;         ///< of hypotheses from where it would be unmoved, and ...
  double carrying_speed_m_per_s = 2.0;  ///< ... as much more as it may have been carried
  double places_per_submap = 160.0;     ///< that look different: a metre apart on its 40 m^2, four headings
  double sure_log_odds = 6.9;           ///< 1000 to 1
  double max_sigma_m = 0.5;             ///< of the place that its matches give, in the worst direction

  static constexpr TuningValue<PlaceHypothesesTuning> kValues[] = {
      {"way_between_m", &PlaceHypothesesTuning::way_between_m},
      {"max_queries", &PlaceHypothesesTuning::max_queries},
      {"max_hypotheses", &PlaceHypothesesTuning::max_hypotheses},
      {"not_moved_odds", &PlaceHypothesesTuning::not_moved_odds},
      {"unmoved_reach_m", &PlaceHypothesesTuning::unmoved_reach_m},
      {"carrying_speed_m_per_s", &PlaceHypothesesTuning::carrying_speed_m_per_s},
      {"places_per_submap", &PlaceHypothesesTuning::places_per_submap},
      {"sure_log_odds", &PlaceHypothesesTuning::sure_log_odds},
      {"max_sigma_m", &PlaceHypothesesTuning::max_sigma_m}};
};

struct RelativeCovarianceTuning {
  double min_dcs_scale = 0.5;  ///< of closures and headings that count
  double lever_m = 2.0;        ///< turns an error of heading into one of position: the reach of the beams

  static constexpr TuningValue<RelativeCovarianceTuning> kValues[] = {
      {"min_dcs_scale", &RelativeCovarianceTuning::min_dcs_scale},
      {"lever_m", &RelativeCovarianceTuning::lever_m}};
};

/// Shares and probabilities: figures of 60 simulated buildings, docs/results/confidence.md.
struct ConfidenceTuning {
  double slip_along_m2_per_m = 0.024;   ///< variance of dead reckoning beyond its noise model, along ...
  double slip_yaw_rad2_per_m = 2.8e-4;  ///< ... and of its heading: of 0.020, 0.024, 0.028 and 0.034 the
                                        ///< least with which 92 % of the 95 % ellipsoids of seeds 0
                                        ///< to 299 hold, 10, 20 and 60 m from the start
  double recompute_after_m = 2.0;       ///< of way: between, covariances are carried on
  double old_after_m = 15.0;            ///< ground flown this much travel ago is older map
  double near_m = 3.0;                  ///< so far from the vehicle, the reach of its beams, it counts
  double way_between_m = 0.1;           ///< scans are compared after so much travel, or ...
  double turn_between_rad = 0.1;        ///< ... turn
  double tolerance_m = 0.32;            ///< a wall so near to where a beam ends is met
  double occupied_probability = 0.55;   ///< of a cell that is such a wall
  double wall_probability = 0.7;        ///< of one that no beam passes
  double free_probability = 0.4;        ///< of one that is free, at most
  double share_if_right = 0.02;  ///< of the returns that contradict the older map, where the pose is right
  double share_if_off = 0.2;     ///< likewise, where it is off by half a metre or more
  double returns_in_full = 4.0;  ///< of a scan; more count as so many: neighbouring beams meet one wall
  double alarm_log_odds = 19.6;  ///< a right pose meets 18000 returns in an hour: 9.8, were they independent;
                                 ///< those of scans 0.1 m apart count for about half
  double recent_returns = 50.0;  ///< the published share is of about so many

  static constexpr TuningValue<ConfidenceTuning> kValues[] = {
      {"slip_along_m2_per_m", &ConfidenceTuning::slip_along_m2_per_m},
      {"slip_yaw_rad2_per_m", &ConfidenceTuning::slip_yaw_rad2_per_m},
      {"recompute_after_m", &ConfidenceTuning::recompute_after_m},
      {"old_after_m", &ConfidenceTuning::old_after_m},
      {"near_m", &ConfidenceTuning::near_m},
      {"way_between_m", &ConfidenceTuning::way_between_m},
      {"turn_between_rad", &ConfidenceTuning::turn_between_rad},
      {"tolerance_m", &ConfidenceTuning::tolerance_m},
      {"occupied_probability", &ConfidenceTuning::occupied_probability},
      {"wall_probability", &ConfidenceTuning::wall_probability},
      {"free_probability", &ConfidenceTuning::free_probability},
      {"share_if_right", &ConfidenceTuning::share_if_right},
      {"share_if_off", &ConfidenceTuning::share_if_off},
      {"returns_in_full", &ConfidenceTuning::returns_in_full},
      {"alarm_log_odds", &ConfidenceTuning::alarm_log_odds},
      {"recent_returns", &ConfidenceTuning::recent_returns}};
};

struct BuildingAxisPriorTuning {
  double gate_sigmas = 4.0;  ///< between votes that agree: wheels lose more in a turn than their model has
  double slip_factor = 3.0;  ///< standard deviation of a slip over that of the model: Killian's robot lost 38
                             ///< degrees in spins of which the model has 4 to 9
  double slip_share = 0.1;   ///< of votes that follow a slip, a priori: with none Killian's slips are
                             ///< other axes, with a half the wings of buildings are slips
  double min_log_odds = 6.0;     ///< of an axis over any other, and over one the other way round, where the
                                 ///< heading is off by the rest of a quarter turn: 400 to 1
  double variance_factor = 3.0;  ///< headings a few metres apart come from the same walls and err together

  static constexpr TuningValue<BuildingAxisPriorTuning> kValues[] = {
      {"gate_sigmas", &BuildingAxisPriorTuning::gate_sigmas},
      {"slip_factor", &BuildingAxisPriorTuning::slip_factor},
      {"slip_share", &BuildingAxisPriorTuning::slip_share},
      {"min_log_odds", &BuildingAxisPriorTuning::min_log_odds},
      {"variance_factor", &BuildingAxisPriorTuning::variance_factor}};
};

/// When the graph is optimised while it grows, and how far.
struct KeyframeGraphTuning {
  double expected_chi_square = 1.0;       ///< a new factor with no more waits for others ...
  std::size_t max_keyframes_waiting = 8;  ///< ... so long
  double live_step = 1e-3;                ///< metres or radians, converged; the next keyframe goes on
  int live_iterations = 4;                ///< a keyframe
  double final_step = 1e-5;               ///< metres or radians, converged at the end of the run
  double max_misfit = 1.5;  ///< chi-square a closure of a place: half of the three that its degrees of
                            ///< freedom would allow, for the covariances of matches are wide
  double lost_heading_rad = radians(15);  ///< standard deviation from which on motion alone does not give it
  double axis_every_share =
      0.5;  ///< of a submap's length: travel between observations of the building's axis

  static constexpr TuningValue<KeyframeGraphTuning> kValues[] = {
      {"expected_chi_square", &KeyframeGraphTuning::expected_chi_square},
      {"max_keyframes_waiting", &KeyframeGraphTuning::max_keyframes_waiting},
      {"live_step", &KeyframeGraphTuning::live_step},
      {"live_iterations", &KeyframeGraphTuning::live_iterations},
      {"final_step", &KeyframeGraphTuning::final_step},
      {"max_misfit", &KeyframeGraphTuning::max_misfit},
      {"lost_heading_rad", &KeyframeGraphTuning::lost_heading_rad},
      {"axis_every_share", &KeyframeGraphTuning::axis_every_share}};
};

/// What makes points a stretch of wall.
struct WallFitTuning {
  double radius_m = 0.3;             ///< around a return
  std::size_t min_points = 5;        ///< fewer make no wall
  double min_variance_m2 = 0.004;    ///< along the wall: shorter stretches have no direction
  double max_variance_ratio = 0.35;  ///< across to along: more is clutter, not a wall
  double robust_sigmas = 1.5;        ///< of a return from it: scale of the Geman-McClure kernel

  static constexpr TuningValue<WallFitTuning> kValues[] = {
      {"radius_m", &WallFitTuning::radius_m},
      {"min_points", &WallFitTuning::min_points},
      {"min_variance_m2", &WallFitTuning::min_variance_m2},
      {"max_variance_ratio", &WallFitTuning::max_variance_ratio},
      {"robust_sigmas", &WallFitTuning::robust_sigmas}};
};

/// Joint refinement, batch and online.
struct RefinementTuning {
  // Walls
  WallFitTuning walls;
  double thinning_cell_m = 0.08;  ///< each traversal draws one point per cell

  // Point-to-line factors
  double wall_sigma_m = 0.05;  ///< of a return from its wall

  // Held-out returns
  std::size_t hold_out_every = 10;    ///< one return in so many
  double cap_sigmas = 3.0;            ///< of wall_sigma_m: greater distances count as this
  double refined_gain_sigmas = 1.64;  ///< 95 %, one-sided: refined dead reckoning must explain that much more
  double correction_odds = 4.0;       ///< to one, a priori: of a correction between walls, against it without
  double median_drift = 0.03;         ///< of dead reckoning on real logs: position error over way

  // Batch refinement
  double wide_radius_m =
      0.5;  ///< instead of the fit's radius in the first iterations: walls may lie this far apart
  int wide_iterations = 5;

  // Windows of the online refinement
  std::size_t max_window_returns = 3000;  ///< a window with more is thinned
  double step_weight = 0.25;              ///< on information: errors of dead reckoning persist, and add up
  double tie_sigma_m = 0.3;     ///< of each keyframe to its pose in the graph, for poses without walls: the
                                ///< graph's error at places flown before, rms 0.15 to 0.3 m in most worlds
  double tie_sigma_rad = 0.05;  ///< likewise

  static constexpr TuningValue<RefinementTuning> kValues[] = {
      {"thinning_cell_m", &RefinementTuning::thinning_cell_m},
      {"wall_sigma_m", &RefinementTuning::wall_sigma_m},
      {"hold_out_every", &RefinementTuning::hold_out_every},
      {"cap_sigmas", &RefinementTuning::cap_sigmas},
      {"refined_gain_sigmas", &RefinementTuning::refined_gain_sigmas},
      {"correction_odds", &RefinementTuning::correction_odds},
      {"median_drift", &RefinementTuning::median_drift},
      {"wide_radius_m", &RefinementTuning::wide_radius_m},
      {"wide_iterations", &RefinementTuning::wide_iterations},
      {"max_window_returns", &RefinementTuning::max_window_returns},
      {"step_weight", &RefinementTuning::step_weight},
      {"tie_sigma_m", &RefinementTuning::tie_sigma_m},
      {"tie_sigma_rad", &RefinementTuning::tie_sigma_rad}};
};

struct WallPatchesTuning {
  double cell_m = 0.5;             ///< a patch lies in one cell
  std::size_t min_neighbours = 6;  ///< around a return, in place of the fit's min_points, ...
  double min_length_m2 = 0.003;    ///< ... and of its min_variance_m2: returns as they are, not thinned
  double max_off_m = 0.12;         ///< of a return from its patch
  double min_agreement = 0.9;      ///< cosine between two normals of one patch
  std::size_t min_returns = 8;

  static constexpr TuningValue<WallPatchesTuning> kValues[] = {
      {"cell_m", &WallPatchesTuning::cell_m},
      {"min_neighbours", &WallPatchesTuning::min_neighbours},
      {"min_length_m2", &WallPatchesTuning::min_length_m2},
      {"max_off_m", &WallPatchesTuning::max_off_m},
      {"min_agreement", &WallPatchesTuning::min_agreement},
      {"min_returns", &WallPatchesTuning::min_returns}};
};

/// A node of rigid dead reckoning ends before the first of these is exceeded. Over this way dead reckoning
/// errs by about as much as one reading, 2 cm. Turn and duration are set by hand. Nodes of 0.1 m and 0.1 rad
/// turn ACES by 0.005 deg less, and take 18 % more memory on Killian (limit: docs/real_time_evidence.md).
struct RigidNodesTuning {
  double way_m = 0.15;
  double turn_rad = 0.25;
  double duration_s = 1.0;

  static constexpr TuningValue<RigidNodesTuning> kValues[] = {{"way_m", &RigidNodesTuning::way_m},
                                                              {"turn_rad", &RigidNodesTuning::turn_rad},
                                                              {"duration_s", &RigidNodesTuning::duration_s}};
};

/// Returns and the patches that they lie on, whose places are unknown.
struct PosesAndWallsTuning {
  double min_incidence_cosine = 0.35;   ///< 70 degrees: so far the flights' returns lie on their walls;
                                        ///< flatter beams often belong to another wall
  double patch_distance_sigma_m = 1.0;  ///< ties a patch to where it was found, where returns leave it free
  double patch_turn_sigma_rad = 0.3;    ///< likewise

  static constexpr TuningValue<PosesAndWallsTuning> kValues[] = {
      {"min_incidence_cosine", &PosesAndWallsTuning::min_incidence_cosine},
      {"patch_distance_sigma_m", &PosesAndWallsTuning::patch_distance_sigma_m},
      {"patch_turn_sigma_rad", &PosesAndWallsTuning::patch_turn_sigma_rad}};
};

/// Poses and walls of a whole run in one problem.
struct JointRefinementTuning {
  int associations = 2;  ///< of returns with patches
  int steps_per_association = 2;
  double age_sigma_s = 0.02;     ///< of the ranges' age: what the estimate before the run leaves
  double closure_weight = 0.08;  ///< on information: six queries see each return, against two submaps

  static constexpr TuningValue<JointRefinementTuning> kValues[] = {
      {"associations", &JointRefinementTuning::associations},
      {"steps_per_association", &JointRefinementTuning::steps_per_association},
      {"age_sigma_s", &JointRefinementTuning::age_sigma_s},
      {"closure_weight", &JointRefinementTuning::closure_weight}};
};

/// Floors of which a flow sensor sees a part. Cells of 1 and 2 m and half and twice the usual error make
/// little difference: docs/decisions/0030-floors-are-unknowns.md.
struct FloorFieldTuning {
  double cell_m = 1.5;       ///< side: what differs in a room is carpets, mats and puddles of light
  double usual_error = 0.1;  ///< scale of the Cauchy prior: half of the cells err by less
  int associations = 6;      ///< of returns with patches: an error of a passage moves all behind it
  double min_cost = 2.3;     ///< log odds, 10 to 1: floors that differ must have paid so much

  static constexpr TuningValue<FloorFieldTuning> kValues[] = {
      {"cell_m", &FloorFieldTuning::cell_m},
      {"usual_error", &FloorFieldTuning::usual_error},
      {"associations", &FloorFieldTuning::associations},
      {"min_cost", &FloorFieldTuning::min_cost}};
};

/// What a step of the online refinement may cost, and where it takes place.
struct OnlineRefinementTuning {
  std::size_t max_window_scans = 300;       ///< of the newest window
  std::size_t max_stretch_scans = 4096;     ///< of the newest stretch: seven minutes of flight at 10 Hz
  std::size_t max_traversal_scans = 100;    ///< that draw its walls; of more every n-th
  std::size_t returns_per_place = 5;        ///< of a window, looked up once: neighbours lie in the same tile
  std::size_t keyframes_of_correction = 4;  ///< whose mean the correction leads to: about 2 m

  static constexpr TuningValue<OnlineRefinementTuning> kValues[] = {
      {"max_window_scans", &OnlineRefinementTuning::max_window_scans},
      {"max_stretch_scans", &OnlineRefinementTuning::max_stretch_scans},
      {"max_traversal_scans", &OnlineRefinementTuning::max_traversal_scans},
      {"returns_per_place", &OnlineRefinementTuning::returns_per_place},
      {"keyframes_of_correction", &OnlineRefinementTuning::keyframes_of_correction}};
};

struct TraversalIndexTuning {
  double tile_m = 2.0;                         ///< side of a tile; pruning counts traversals in the same
  double refile_m = 0.2;                       ///< a traversal that has moved this far is filed anew
  std::size_t max_points_per_traversal = 256;  ///< of more, some are left out evenly
  std::size_t max_traversals_nearby = 64;      ///< found at once
  std::size_t max_traversals_per_tile = 8;     ///< of more, chosen evenly from the first to the last

  static constexpr TuningValue<TraversalIndexTuning> kValues[] = {
      {"tile_m", &TraversalIndexTuning::tile_m},
      {"refile_m", &TraversalIndexTuning::refile_m},
      {"max_points_per_traversal", &TraversalIndexTuning::max_points_per_traversal},
      {"max_traversals_nearby", &TraversalIndexTuning::max_traversals_nearby},
      {"max_traversals_per_tile", &TraversalIndexTuning::max_traversals_per_tile}};
};

struct PruningTuning {
  std::size_t returns_per_traversal = 64;  ///< sampled to find where it was
  double share_of_returns = 0.9;           ///< decides: the rest are glances through doors
  std::size_t kept_per_tile = 3;           ///< of the oldest traversals in it, and of the newest
  std::size_t min_run = 4;                 ///< traversals: every hole needs ties on both sides
  double share_at_a_time = 0.05;           ///< of the most scans
  double tie_sigma_m = 0.1;                ///< at least: looser than what loops tell of a place
  double tie_sigma_rad = 0.05;             ///< likewise

  static constexpr TuningValue<PruningTuning> kValues[] = {
      {"returns_per_traversal", &PruningTuning::returns_per_traversal},
      {"share_of_returns", &PruningTuning::share_of_returns},
      {"kept_per_tile", &PruningTuning::kept_per_tile},
      {"min_run", &PruningTuning::min_run},
      {"share_at_a_time", &PruningTuning::share_at_a_time},
      {"tie_sigma_m", &PruningTuning::tie_sigma_m},
      {"tie_sigma_rad", &PruningTuning::tie_sigma_rad}};
};

struct BackendTuning {
  SubmapTuning submap;
  LoopDetectorTuning detector;
  CorrelativeMatcherTuning matcher;
  CrossCheckTuning cross_check;
  PlaceHypothesesTuning places;
  RelativeCovarianceTuning covariance;
  ConfidenceTuning confidence;
  BuildingAxisPriorTuning axis;
  WallAxisTuning walls;  ///< that the building's axis is estimated from
  KeyframeGraphTuning graph;
  RefinementTuning refinement;
  JointRefinementTuning joint;
  FloorFieldTuning floor;
  PosesAndWallsTuning poses_and_walls;
  RigidNodesTuning nodes;
  WallPatchesTuning patches;
  OnlineRefinementTuning online;
  TraversalIndexTuning index;
  PruningTuning pruning;
};

}  // namespace swiftlet
