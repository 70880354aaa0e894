// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

/// Functions of their own may use AVX2, by [[gnu::target("avx2")]], where has_avx2() says so at run time.
#if defined(__x86_64__) || defined(__i386__)
#define SWIFTLET_MAY_HAVE_AVX2 1
#else
#define SWIFTLET_MAY_HAVE_AVX2 0
#endif

namespace swiftlet {

#if SWIFTLET_MAY_HAVE_AVX2
inline bool has_avx2() {
  static const bool kHas = __builtin_cpu_supports("avx2");
  return kHas;
}
#endif

}  // namespace swiftlet
