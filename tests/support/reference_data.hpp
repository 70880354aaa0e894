// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <cstdlib>
#include <filesystem>
#include <string>

#include "tests/support/checkout.hpp"

namespace swiftlet {

/// Where a file of the reference data would be: the folder that SWIFTLET_DATASETS names, else
/// ../shared/datasets beside the checkout.
inline std::string reference_file(const std::string& name) {
  const char* folder = std::getenv("SWIFTLET_DATASETS");
  const std::filesystem::path root =
      folder != nullptr ? std::filesystem::path(folder) : checkout().parent_path() / "shared" / "datasets";
  return (root / name).string();
}

}  // namespace swiftlet

/// Skips the test, by the file's name, where the reference data is absent.
#define SWIFTLET_REQUIRE_REFERENCE(path) \
  if (!std::filesystem::exists(path)) GTEST_SKIP() << "no reference data: " << (path)
