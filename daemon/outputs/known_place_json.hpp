// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "core/evaluation/known_place_error.hpp"

namespace swiftlet {

/// As docs/evaluation.md describes it.
[[nodiscard]] nlohmann::ordered_json known_place_json(const KnownPlaceError& error);

}  // namespace swiftlet
