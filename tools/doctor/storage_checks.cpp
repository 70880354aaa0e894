// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "tools/doctor/storage_checks.hpp"

#include <unistd.h>

#include <cstdio>
#include <string>
#include <system_error>

namespace swiftlet {
namespace {

namespace fs = std::filesystem;

constexpr std::uintmax_t kScarceBytes = 100'000'000;

std::string megabytes(std::uintmax_t bytes) { return std::to_string(bytes / 1'000'000) + " MB"; }

/// The directory itself, or the nearest one above it that is there.
fs::path existing_part(fs::path path) {
  std::error_code error;
  while (!fs::exists(path, error) && path.has_parent_path() && path != path.parent_path())
    path = path.parent_path();
  return path;
}

}  // namespace

Finding check_storage(const fs::path& directory) {
  if (directory.empty())
    return {Mark::kWarning, "recordings", "nowhere to keep them: neither HOME nor XDG_STATE_HOME is set",
            "say where with swiftletd --record FILE"};
  const fs::path existing = existing_part(directory);
  std::error_code error;
  if (!fs::is_directory(existing, error))
    return {Mark::kWarning, "recordings", existing.string() + " is no directory", "move it out of the way"};
  if (access(existing.c_str(), W_OK | X_OK) != 0)
    return {Mark::kWarning, "recordings",
            existing.string() + " cannot be written: flights leave no recording",
            "sudo chown $USER " + existing.string() + ", or swiftletd --record FILE"};
  const fs::space_info space = fs::space(existing, error);
  if (error) return {Mark::kWarning, "recordings", existing.string() + ": " + error.message(), ""};
  const std::string room = directory.string() + ", " + megabytes(space.available) + " free";
  if (space.available < kScarceBytes)
    return {Mark::kWarning, "recordings", room, "make room: on a full disk the recording stops"};
  return {Mark::kOk, "recordings", room, ""};
}

}  // namespace swiftlet
