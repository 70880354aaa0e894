// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <string>

#include "core/base/result.hpp"

namespace swiftlet {

/// What a trajectory can be held against.
enum class ReferenceKind {
  kRelations,  ///< true motions between stamps
  kTruth,      ///< true poses, a TUM trajectory
  kFlight,     ///< the capture that the trajectory was made from
};

/// Decides by the content. A capture begins like one (or is named .pcap). Relations and TUM trajectories both
/// have eight columns: a name that ends in .relations or .relations.gz settles it; otherwise either all lines
/// must end in a unit quaternion (TUM) or all have a second stamp within the time of the first ones and up to
/// a day later (relations), but not both.
///
/// Errors: kNotFound, kInvalidInput, kDamaged: as read_number_rows(). kInvalidInput: undecidable; the message
/// gives the evidence for each, and how to state the kind.
[[nodiscard]] Result<ReferenceKind> recognise_reference(const std::string& path);

}  // namespace swiftlet
