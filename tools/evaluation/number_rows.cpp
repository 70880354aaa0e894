// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "tools/evaluation/number_rows.hpp"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <optional>
#include <string_view>

#include "firmware_link/file/gzip_lines.hpp"
#include "firmware_link/sample_table/table_fields.hpp"

namespace swiftlet {
namespace {

constexpr std::string_view kBlanks = " \t";

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

/// Also with a plus sign, which numpy.savetxt("%+.6e") writes. Nothing where the text is no finite number.
std::optional<double> finite_number_in(std::string_view text) {
  if (text.starts_with('+') && !text.starts_with("+-")) text.remove_prefix(1);
  const std::optional<double> value = parse_number<double>(text);
  return value && std::isfinite(*value) ? value : std::nullopt;
}

/// What is wrong with the columns, or nothing.
std::string parse(const std::vector<std::string_view>& columns, NumberRow& row) {
  for (std::size_t i = 0; i < std::min(columns.size(), kRowColumns); ++i) {
    const std::optional<double> value = finite_number_in(columns[i]);
    if (!value) return fmt::format("column {}, '{}', is no finite number", i + 1, quoted(columns[i]));
    row.value[i] = *value;
  }
  if (columns.size() == kRowColumns) return {};
  return fmt::format("has {} column{}, not {} separated by blanks", columns.size(),
                     columns.size() == 1 ? "" : "s", kRowColumns);
}

/// Half a reference gives the figures of half a run: it is refused, unlike half a capture.
Error cut_or_garbled(const std::string& path, std::uint64_t lines) {
  return {ErrorCode::kDamaged,
          fmt::format("{}: the gzip stream is cut off or garbled behind line {}, and nothing of it is used; "
                      "take a whole copy",
                      path, lines)};
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
  if (line.error().code == ErrorCode::kDamaged) return cut_or_garbled(path, lines->line_number());
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
