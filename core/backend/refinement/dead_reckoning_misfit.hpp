// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <span>

#include "core/backend/refinement/rigid_nodes.hpp"
#include "core/sensing/systematic_prior.hpp"

namespace swiftlet {

/// Minus the log likelihood of what dead reckoning reports, in nats but for a constant, if the scans lie at
/// `T_map_body`, one pose per scan of `nodes`. The errors that go on through a whole run are those that suit
/// this path best, at the price of their prior; a path that was refined with other ones is not charged for
/// them at each step. What is left of the motion from node to node costs half of its dcs_cost(), so that one
/// slip does not outweigh the rest. `prior`: zero where an error is none. Allocates. Repeatable.
[[nodiscard]] double dead_reckoning_misfit(RigidNodes nodes, const SystematicCovariance& prior,
                                           std::span<const Pose2> T_map_body, double dcs_phi);

}  // namespace swiftlet
