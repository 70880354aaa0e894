// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

namespace swiftlet {

/// Whether text to this file descriptor is to have colours: on a terminal, unless the user wants none
/// (https://no-color.org). Before threads run.
[[nodiscard]] bool wants_colours(int file);

}  // namespace swiftlet
