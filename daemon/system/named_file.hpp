// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <CLI/CLI.hpp>
#include <string>

namespace swiftlet {

/// For an option that takes a file: an unset variable of a script names none.
inline CLI::Validator named_file() {
  const auto problem_with = [](const std::string& name) {
    return name.empty() ? std::string("names no file; name one, or leave the option out") : std::string();
  };
  return {problem_with, ""};
}

}  // namespace swiftlet
