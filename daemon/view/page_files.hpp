// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include "daemon/view/web_site.hpp"

namespace swiftlet {

/// The files of daemon/view/page, which the build puts into the program; index.html is also "/".
[[nodiscard]] PageFiles page_files();

}  // namespace swiftlet
