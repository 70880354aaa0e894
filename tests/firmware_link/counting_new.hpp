// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <cstddef>

namespace swiftlet {

/// How often operator new was called in this program, which must be linked with counting_new.cpp. Enough for
/// code that allocates in no other way (no Eigen, no C library).
std::size_t allocation_count();

}  // namespace swiftlet
