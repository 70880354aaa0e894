// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace swiftlet {

/// What the system reports of itself in files: /proc, /sys, /etc. Tests put a directory of their own in the
/// place of "/". Whatever cannot be read is as if it were not there.
class SystemFiles {
 public:
  explicit SystemFiles(std::filesystem::path root = "/") : root_(std::move(root)) {}

  [[nodiscard]] bool exists(const std::string& path) const;
  /// The whole file without the line ends at its end. At most 64 kB.
  [[nodiscard]] std::optional<std::string> read(const std::string& path) const;
  [[nodiscard]] std::optional<long long> read_number(const std::string& path) const;
  /// Names in a directory, sorted.
  [[nodiscard]] std::vector<std::string> names_in(const std::string& path) const;
  /// Where a symbolic link points, as it is written there.
  [[nodiscard]] std::optional<std::string> target_of(const std::string& path) const;

 private:
  std::filesystem::path root_;
  [[nodiscard]] std::filesystem::path real(const std::string& path) const;
};

/// The rest of the first line that begins with `key`, without the blanks around it.
[[nodiscard]] std::optional<std::string> field_of(std::string_view text, std::string_view key);

}  // namespace swiftlet
