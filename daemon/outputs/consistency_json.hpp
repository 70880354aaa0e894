// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "daemon/outputs/run_outputs.hpp"

namespace swiftlet {

/// The object `consistency` of reports: a row for each distance that the run reached, and its alarms.
nlohmann::ordered_json consistency_json(const RunConsistency& consistency);

}  // namespace swiftlet
