// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <cstdint>

namespace swiftlet {

/// What a worker's step came to; its thread decides by it how to go on.
enum class StepResult : std::uint8_t {
  kProgress,  ///< something was done: call again
  kIdle,      ///< nothing to do until more input comes
  kBlocked,   ///< there is work, but no room behind it: call again in a moment
  kFinished,  ///< the input has ended and everything is handed on; stays so
};

}  // namespace swiftlet
