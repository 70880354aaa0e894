// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <string>

#include "daemon/manual/command_text.hpp"

namespace swiftlet {

/// A bash script that completes commands, options and choices, and files where a file may stand.
[[nodiscard]] std::string bash_completion(const CommandText& program);

/// The same for zsh, as a file of its fpath.
[[nodiscard]] std::string zsh_completion(const CommandText& program);

}  // namespace swiftlet
