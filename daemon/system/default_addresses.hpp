// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <cstdint>
#include <string>

namespace swiftlet {

inline constexpr std::uint16_t kViewPort = 8440;      ///< of the page, for browsers
inline constexpr std::uint16_t kCommandsPort = 8450;  ///< for `swiftlet tell` and other programs

/// `ADDRESS:PORT`. Allocates.
inline std::string on_this_machine(std::uint16_t port) { return "127.0.0.1:" + std::to_string(port); }

}  // namespace swiftlet
