// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <filesystem>

namespace swiftlet {

/// The checkout that the tests were built from.
std::filesystem::path checkout();

}  // namespace swiftlet
