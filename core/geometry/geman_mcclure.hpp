// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include "core/geometry/squared.hpp"

namespace swiftlet {

/// By how much less a residual counts that is `ratio` times the scale of the kernel: 1 at none, 4 at the
/// scale (Geman & McClure, "Statistical methods for tomographic image reconstruction", 1987).
constexpr double geman_mcclure_divisor(double ratio) { return squared(1.0 + ratio * ratio); }

}  // namespace swiftlet
