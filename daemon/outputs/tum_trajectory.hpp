// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <string>

#include "core/base/time.hpp"
#include "core/geometry/pose2.hpp"

namespace swiftlet {

/// Appends one line of a TUM trajectory: "stamp x y z qx qy qz qw", the stamp in seconds to the microsecond
/// (printed from the integer, so a Unix time keeps every digit), z, qx and qy zero.
void append_tum_line(std::string& text, HostTime stamp, const Pose2& pose);

}  // namespace swiftlet
