// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <string_view>

namespace swiftlet {

/// A path of its own for the running test, removed at the end with the file there.
class TemporaryFile {
 public:
  explicit TemporaryFile(const std::string& name) {
    const auto* info = testing::UnitTest::GetInstance()->current_test_info();
    std::string file = std::string(info->test_suite_name()) + "." + info->name() + "." + name;
    std::replace(file.begin(), file.end(), '/', '.');  // of parameterised tests
    path_ = (std::filesystem::path(testing::TempDir()) / file).string();
    std::filesystem::remove_all(path_);
  }
  TemporaryFile(const std::string& name, std::string_view text) : TemporaryFile(name) {
    std::ofstream(path_, std::ios::binary) << text;
  }
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;
  ~TemporaryFile() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }

  [[nodiscard]] const std::string& path() const { return path_; }
  [[nodiscard]] std::string read() const {
    std::ostringstream bytes;
    bytes << std::ifstream(path_, std::ios::binary).rdbuf();
    return bytes.str();
  }
  void write(std::string_view bytes) const { std::ofstream(path_, std::ios::binary) << bytes; }

 private:
  std::string path_;
};

}  // namespace swiftlet
