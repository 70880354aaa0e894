// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "core/base/result.hpp"
#include "core/base/time.hpp"

namespace swiftlet {

inline constexpr std::size_t kRowColumns = 8;

/// A line of a text file: a TUM trajectory and a list of relations have eight numbers in each.
struct NumberRow {
  std::uint64_t line = 0;  ///< from 1
  std::array<double, kRowColumns> value{};
};

/// Reads a text file, plain or gzip; empty lines and those that begin with # are skipped, columns are
/// separated by blanks. A byte order mark at the beginning and plus signs are accepted. Errors: kNotFound,
/// kInvalidInput: no such file, a line of other than eight finite numbers (by file, line and column), or no
/// line at all. kDamaged: a damaged gzip stream, of which nothing is used.
[[nodiscard]] Result<std::vector<NumberRow>> read_number_rows(const std::string& path);

/// A column in seconds as a stamp, to the microsecond: that undoes the rounding of the binary number. Errors:
/// kInvalidInput: more than 4e9 s from 1970; `path` and the row's line are in the message.
[[nodiscard]] Result<HostTime> stamp_in(const NumberRow& row, std::size_t column, const std::string& path);

/// "FILE:LINE: WHAT".
[[nodiscard]] Error error_in_line(const std::string& path, std::uint64_t line, const std::string& what);

}  // namespace swiftlet
