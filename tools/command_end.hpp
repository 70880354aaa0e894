// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <string>

#include "core/base/result.hpp"
#include "firmware_link/sample/sample_source.hpp"

namespace swiftlet {

/// On stderr.
void print_note(const std::string& note);

/// All that was wrong with the input, in one line: kDamaged.
[[nodiscard]] Status damage_of(const InputReport& report);

/// How a command ends that has told its results: prints the notes; the damage, and why a file of results was
/// not written, in one line.
[[nodiscard]] Status conclude(const Status& written, const InputReport& input);

}  // namespace swiftlet
