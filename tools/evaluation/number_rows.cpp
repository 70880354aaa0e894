// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "tools/evaluation/number_rows.hpp"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <charconv>
#include <chrono>
#include <cmath>
#include <string_view>

#include "firmware_link/file/gzip_lines.hpp"

namespace swiftlet {
namespace {

constexpr std::string_view kBlanks = " \t";
constexpr std::size_t kMaxQuote = 40;

std::vector<std::string_view> columns_of(std::string_view line) {
  std::vector<std::string_view> columns;
  for (std::size_t begin = line.find_first_not_of(kBlanks); begin != std::string_view::npos;
       begin = line.find_first_not_of(kBlanks)) {
    line.remove_prefix(begin);
    const std::size_t size = std::min(line.find_first_of(kBlanks), line.size());
    columns.push_back(line.substr(0, size));
    line.remove_prefix(size);
  }
  return columns;
}

/// Fit for a message, whatever the file holds.
std::string quoted(std::string_view text) {
  std::string quote(text.substr(0, kMaxQuote));
  std::replace_if(
      quote.begin(), quote.end(), [](char c) { return c < ' ' || c > '~'; }, '?');
  return quote;
}

/// What is wrong with the columns, or nothing.
std::string parse(const std::vector<std::string_view>& columns, NumberRow& row) {
  for (std::size_t i = 0; i < std::min(columns.size(), kRowColumns); ++i) {
    const std::string_view text = columns[i];
    const auto [rest, error] = std::from_chars(text.data(), text.data() + text.size(), row.value[i]);
    if (error != std::errc{} || rest != text.data() + text.size() || !std::isfinite(row.value[i]))
      return fmt::format("column {}, '{}', is no finite number", i + 1, quoted(text));
  }
  if (columns.size() == kRowColumns) return {};
  return fmt::format("has {} column{}, not {} separated by blanks", columns.size(),
                     columns.size() == 1 ? "" : "s", kRowColumns);
}

}  // namespace

Error error_in_line(const std::string& path, std::uint64_t line, const std::string& what) {
  return {ErrorCode::kInvalidInput, fmt::format("{}:{}: {}", path, line, what)};
}

Result<std::vector<NumberRow>> read_number_rows(const std::string& path) {
  Result<GzipLines> lines = GzipLines::open(path);
  if (!lines) return lines.error();
  std::vector<NumberRow> rows;
  Result<std::string_view> line = lines->next();
  for (; line; line = lines->next()) {
    const std::vector<std::string_view> columns = columns_of(*line);
    if (columns.empty() || columns.front().starts_with('#')) continue;
    NumberRow row{.line = lines->line_number()};
    if (const std::string fault = parse(columns, row); !fault.empty())
      return error_in_line(path, row.line, fault);
    rows.push_back(row);
  }
  if (line.error().code != ErrorCode::kEndOfRecording) return line.error();
  if (rows.empty()) return Error{ErrorCode::kInvalidInput, path + ": holds no line of numbers"};
  return rows;
}

Result<HostTime> stamp_in(const NumberRow& row, std::size_t column, const std::string& path) {
  constexpr double kLimitS = 4e9;  // differences must fit, too
  const double seconds = row.value[column];
  if (!(std::abs(seconds) <= kLimitS))
    return error_in_line(path, row.line,
                         fmt::format("column {}, {}, is no stamp in seconds", column + 1, seconds));
  return HostTime(std::chrono::microseconds(std::llround(seconds * 1e6)));
}

}  // namespace swiftlet
