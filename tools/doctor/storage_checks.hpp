// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <filesystem>

#include "tools/doctor/finding.hpp"

namespace swiftlet {

/// "recordings": whether `directory`, where swiftletd keeps them, can be made or written, and how much room
/// is there. Leaves nothing behind.
[[nodiscard]] Finding check_storage(const std::filesystem::path& directory);

}  // namespace swiftlet
