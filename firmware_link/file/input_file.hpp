// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <cstdint>
#include <string>

#include "core/base/result.hpp"

namespace swiftlet {

/// Size in bytes of a file that can be read. Errors: kNotFound: no such file. kInvalidInput: a directory or
/// device, no permission, or empty. The message is written for the user.
[[nodiscard]] Result<std::uint64_t> size_of_input_file(const std::string& path);

/// By content: the magic numbers of pcap files, classic or not, plain or within gzip. False if it cannot be
/// read.
[[nodiscard]] bool begins_like_capture(const std::string& path);

}  // namespace swiftlet
