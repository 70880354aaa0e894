// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <stop_token>

#include "daemon/config/configuration.hpp"
#include "daemon/program/options.hpp"

namespace swiftlet {

/// One run of the daemon, and after each that ended by the command for a new map another one, until
/// `signalled`. The worst of their exit codes.
[[nodiscard]] int run_until_over(const Options& options, const Configuration& config,
                                 const std::stop_token& signalled);

}  // namespace swiftlet
