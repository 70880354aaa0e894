// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <CLI/CLI.hpp>

#include "daemon/manual/command_text.hpp"

namespace swiftlet {

/// All that --help shows of an application and its commands; what it hides is left out.
[[nodiscard]] CommandText command_text(const CLI::App& app, const ManualFacts& facts);

/// Adds the hidden option --print-page man|bash|zsh, which prints the manual page or a shell's completion and
/// ends the program as --version does. `app` must outlive its parsing.
void add_page_option(CLI::App& app, const ManualFacts& facts);

}  // namespace swiftlet
