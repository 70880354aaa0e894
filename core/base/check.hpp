// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <cstdio>
#include <cstdlib>

/// Aborts when a caller violates a precondition; active in every build. For programmer errors only: errors
/// from outside (radio, files, users) are returned as a Result. Allocates nothing.
#define SWIFTLET_CHECK(condition, promise)                                                               \
  do {                                                                                                   \
    if (!(condition)) {                                                                                  \
      std::fprintf(stderr, "%s:%d: broken promise: %s (%s)\n", __FILE__, __LINE__, promise, #condition); \
      std::abort();                                                                                      \
    }                                                                                                    \
  } while (false)
