// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <filesystem>
#include <fstream>
#include <string>

#include "tests/daemon/outputs/temporary_directory.hpp"
#include "tools/doctor/system_files.hpp"

namespace swiftlet {

/// A directory that stands for "/" in SystemFiles, with nothing in it but what the test writes.
class FakeSystem {
 public:
  void write(const std::string& path, const std::string& text) const {
    std::filesystem::create_directories(real(path).parent_path());
    std::ofstream(real(path), std::ios::binary) << text;
  }
  void link(const std::string& path, const std::string& target) const {
    std::filesystem::create_directories(real(path).parent_path());
    std::filesystem::create_symlink(target, real(path));
  }
  [[nodiscard]] SystemFiles files() const { return SystemFiles(directory_.path()); }

 private:
  TemporaryDirectory directory_;
  [[nodiscard]] std::filesystem::path real(const std::string& path) const {
    return directory_.path() / std::filesystem::path(path).relative_path();
  }
};

}  // namespace swiftlet
