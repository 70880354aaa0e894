// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "core/backend/config/backend_tuning.hpp"
#include "core/backend/pose_graph/pose_graph.hpp"
#include "core/sensing/wall_axis.hpp"

namespace swiftlet {

/// Constrains headings by the axes that the walls of most buildings share. Dead reckoning by wheels loses
/// degrees with every metre, and loops end tens of metres from where they began; the axis seen at the start
/// gives the heading hundreds of metres later. Similar to the heuristic drift elimination of Borenstein &
/// Ojeda 2010, but in the pose graph, robust, and with as many axes as the building shows. What walls have is
/// a mixture, whose weights are learnt in the building: a known axis, seen after motion as modelled or after
/// a slip, or another axis, anywhere. Where another is likelier, walls that agree with each other have an
/// axis of their own. One thread at a time.
class BuildingAxisPrior {
 public:
  explicit BuildingAxisPrior(const BuildingAxisPriorTuning& tuning = {}) : tuning_(tuning) {}

  /// `axis`: of the walls around `keyframe`, in its frame. `yaw_variance_rad2`: of its heading relative to
  /// that of the last heading factor. Adds heading factors to the graph: one of these walls where they follow
  /// a known axis, those of the last walls where they are told to have another; none where it cannot be told,
  /// or the heading may be a quarter turn off. Allocates.
  void add(KeyframeId keyframe, const WallAxis& axis, double yaw_variance_rad2, PoseGraph& graph);

  /// Erases the headings of these keyframes, here and in the graph.
  void erase(const IdRanges<KeyframeId>& pruned, PoseGraph& graph);
  /// Sets the yaw of each heading factor by the present estimate of its axis.
  void update(PoseGraph& graph) const;

 private:
  /// Walls around a keyframe.
  struct Sight {
    KeyframeId keyframe{};
    WallAxis axis;
    /// Of the keyframe's heading relative to that of the last heading factor.
    double yaw_variance_rad2 = 0.0;
    bool is_elsewhere = false;  ///< another axis is likelier than any shared one
  };
  /// An axis that walls share.
  struct Shared {
    std::size_t headings = 0;
    double variance_rad2 = 0.0;  ///< of its direction relative to the last heading factor's
  };
  /// Of the graph's heading of the same index.
  struct Walls {
    WallAxis axis;  ///< in the frame of the keyframe
    std::size_t shared = 0;
  };
  /// Of walls to a shared axis.
  struct Fit {
    double misfit = 0.0;              ///< in squared standard deviations
    double other_way_round = 0.0;     ///< the same, if the heading is off by the rest of a quarter turn
    bool is_another_likelier = true;  ///< that the walls have another axis than this one
  };
  /// Walls are looked at every half submap: the first and the last of so many sights have none in common.
  static constexpr std::size_t kSightsApart = 3;

  [[nodiscard]] std::vector<Fit> fits_of(const Sight& sight, const PoseGraph& graph) const;
  [[nodiscard]] double likelihood_per_rad(double off_rad, double turned_rad2, double sight_rad2) const;
  /// The shared axis that clearly fits best, each a priori as likely as headings hold to it; where there is
  /// none yet, a first one.
  [[nodiscard]] std::optional<std::size_t> shared_axis(const std::vector<Fit>& fits) const;
  void drop_strays();
  [[nodiscard]] bool continues_strays(const Sight& sight, const PoseGraph& graph) const;
  void observe(std::size_t shared, double yaw_variance_rad2);
  void hold(const Sight& sight, std::size_t shared, PoseGraph& graph);
  /// Axes whose headings were all erased.
  void forget_unseen_axes();
  /// In the map, of all shared axes.
  [[nodiscard]] std::vector<double> directions_rad(const PoseGraph& graph) const;

  BuildingAxisPriorTuning tuning_;
  /// Votes that hold to no axis, but for the strays. Of what is pruned they lose as large a share.
  double unheld_ = 0.0;
  std::vector<Walls> walls_;
  std::vector<Shared> shared_;
  /// Since the last heading factor: they agree with each other, and with no shared axis.
  std::vector<Sight> strays_;
};

}  // namespace swiftlet
