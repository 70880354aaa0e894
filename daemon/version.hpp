// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <string>

namespace swiftlet {

/// What --version prints, two lines: "PROGRAM 0.1.0 (commit ...)", and compiler and libraries of the build.
[[nodiscard]] std::string version_text(const std::string& program);

}  // namespace swiftlet
