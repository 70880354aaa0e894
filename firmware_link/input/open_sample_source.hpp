// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <memory>
#include <string>

#include "core/base/result.hpp"
#include "firmware_link/sample/sample_source.hpp"

namespace swiftlet {

/// Opens an input of any kind (input_forms()). A vehicle need not be there yet. Errors: kInvalidInput or
/// kNotFound with one line: what, where and what to do.
[[nodiscard]] Result<std::unique_ptr<SampleSource>> open_sample_source(const std::string& uri,
                                                                       const SampleSourceOptions& options);

}  // namespace swiftlet
