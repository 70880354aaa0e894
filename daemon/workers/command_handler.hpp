// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <functional>
#include <optional>

#include "core/base/time.hpp"
#include "core/mapping/map_builder.hpp"
#include "daemon/workers/command.hpp"

namespace swiftlet {

/// Executes a command in the backend's thread, between two steps. `newest`: stamp of the newest sample in
/// the backend; nullopt: there is none yet.
using CommandHandler =
    std::function<void(const Command& command, const MapBuilder& map, std::optional<HostTime> newest)>;

}  // namespace swiftlet
