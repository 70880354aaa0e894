// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <memory>
#include <string>

#include "core/base/result.hpp"

namespace swiftlet {

/// The log in a file instead of on stderr, and reopened when whoever rotates logs has moved it away. Any
/// thread. While it lives it is where spdlog writes.
class LogFile {
 public:
  /// Appends. kInvalidInput: the file cannot be opened.
  [[nodiscard]] static Result<std::unique_ptr<LogFile>> open(const std::string& path);
  ~LogFile();
  LogFile(const LogFile&) = delete;
  LogFile& operator=(const LogFile&) = delete;

  /// From here on to a file of the same name, made where there is none. Where that fails the log goes on as
  /// before, with a line on it.
  void reopen();

 private:
  struct State;
  explicit LogFile(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

}  // namespace swiftlet
