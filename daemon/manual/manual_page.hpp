// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <string>

#include "daemon/manual/command_text.hpp"

namespace swiftlet {

/// The page for man, in the macros of man(7); without the newline at its end.
[[nodiscard]] std::string manual_page(const CommandText& program, const ManualFacts& facts);

}  // namespace swiftlet
