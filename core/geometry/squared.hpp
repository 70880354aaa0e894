// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

namespace swiftlet {

constexpr double squared(double x) { return x * x; }

}  // namespace swiftlet
