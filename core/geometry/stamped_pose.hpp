// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include "core/base/time.hpp"
#include "core/geometry/pose2.hpp"

namespace swiftlet {

struct StampedPose {
  HostTime stamp{};
  Pose2 pose;
};

}  // namespace swiftlet
