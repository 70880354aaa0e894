// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "core/base/result.hpp"
#include "core/base/time.hpp"

namespace swiftlet {

/// Where recordings go that nobody named: $STATE_DIRECTORY (its first entry: a service's own), else
/// $XDG_STATE_HOME/swiftlet/recordings, else ~/.local/state/swiftlet/recordings. Error: kNotFound: none of
/// the three is set.
[[nodiscard]] Result<std::filesystem::path> default_recordings_directory();

/// "swiftlet_20261121_105555.pcap" (UTC); from part 2 on "swiftlet_20261121_105555_2.pcap".
[[nodiscard]] std::string recording_name(HostTime began, int part);

/// "296 kB", "64 MB".
[[nodiscard]] std::string size_text(std::uint64_t bytes);

/// Removes the oldest files named as recording_name() does, until those left hold at most `keep_bytes`.
/// Nothing else is ever touched: no other name, no link, no recording that is being written. What it removed.
std::vector<std::filesystem::path> remove_oldest_recordings(const std::filesystem::path& directory,
                                                            std::uint64_t keep_bytes);

}  // namespace swiftlet
