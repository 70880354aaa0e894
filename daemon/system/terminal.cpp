// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "daemon/system/terminal.hpp"

#include <unistd.h>

#include <cstdlib>

namespace swiftlet {

bool wants_colours(int file) {
  const char* refused = std::getenv("NO_COLOR");  // NOLINT(concurrency-mt-unsafe): no thread runs yet
  return ::isatty(file) == 1 && (refused == nullptr || *refused == '\0');
}

}  // namespace swiftlet
