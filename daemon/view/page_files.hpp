// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <functional>
#include <map>
#include <string>

#include "daemon/view/web_server.hpp"

namespace swiftlet {

/// The files of daemon/view/page, which the build puts into the program; index.html is also "/".
[[nodiscard]] std::map<std::string, PageFile, std::less<>> page_files();

}  // namespace swiftlet
