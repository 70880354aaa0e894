// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <string>

#include "tools/evaluation/evaluate.hpp"

namespace swiftlet {

/// A table for each reference, for people. Of unmatched stamps the first few are named and the rest counted.
[[nodiscard]] std::string evaluation_text(const Evaluation& evaluation);

/// All figures in full precision and all unmatched stamps, as docs/evaluation.md describes it.
[[nodiscard]] std::string evaluation_json(const Evaluation& evaluation);

}  // namespace swiftlet
