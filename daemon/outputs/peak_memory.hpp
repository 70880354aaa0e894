// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

namespace swiftlet {

/// The most memory (MiB) this program has held so far, as the kernel counts it (VmHWM). getrusage() would do
/// but for a memory of its own: what the program's parent held when it started this one. 0 where the kernel
/// does not report it. Any thread.
[[nodiscard]] double peak_memory_mb();
/// From now on, what came before does not count. Where the kernel does not let it, it does.
void reset_peak_memory();

}  // namespace swiftlet
