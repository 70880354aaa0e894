// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <stop_token>

#include "core/base/result.hpp"
#include "daemon/view/viewer.hpp"
#include "tools/prepared_run.hpp"

namespace swiftlet {

/// Maps the input as fast as it can, in this thread, and tells `shared` what a daemon would have published
/// and at which moment of the data. Until the end of the input, or until `stop` is requested. Errors:
/// whatever ended the input before its time; what came before has been told.
[[nodiscard]] Status map_recording(PreparedRun& run, SharedRunHistory& shared, const std::stop_token& stop);

}  // namespace swiftlet
