// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <functional>

namespace swiftlet {

/// Called between steps of long work with the share done, 0 to 1; false stops the work.
using GoOn = std::function<bool(double done)>;

}  // namespace swiftlet
