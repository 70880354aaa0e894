// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <cstdint>
#include <span>

#include "core/base/result.hpp"
#include "daemon/workers/command.hpp"

namespace swiftlet {

/// What a command_t asks for. Error: kInvalidInput: what is wrong with it.
[[nodiscard]] Result<Command> read_command(std::span<const std::uint8_t> message);

}  // namespace swiftlet
