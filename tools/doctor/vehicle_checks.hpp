// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include "tools/doctor/finding.hpp"
#include "tools/doctor/vehicle_interview.hpp"

namespace swiftlet {

/// "vehicle firmware", "log", "multiranger", "flow deck", "battery", "motors": whether what answered can be
/// flown and mapped with. Precondition: it answered.
[[nodiscard]] Findings check_vehicle(const VehicleFacts& facts);
/// The same checks, skipped.
[[nodiscard]] Findings skip_vehicle(const std::string& why);

}  // namespace swiftlet
