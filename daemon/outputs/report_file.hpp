// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>

#include "core/base/result.hpp"

namespace swiftlet {

/// The report.json of a run; discarded where it is no JSON. What it holds is for the caller to check. Errors:
/// as size_of_input_file().
[[nodiscard]] Result<nlohmann::ordered_json> read_report(const std::filesystem::path& file);

}  // namespace swiftlet
