// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "tests/support/checkout.hpp"

namespace swiftlet {

std::filesystem::path checkout() { return SWIFTLET_SOURCE_DIR; }

}  // namespace swiftlet
