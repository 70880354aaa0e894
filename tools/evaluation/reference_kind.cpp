// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "tools/evaluation/reference_kind.hpp"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <vector>

#include "firmware_link/file/input_file.hpp"
#include "tools/evaluation/number_rows.hpp"
#include "tools/evaluation/tum_file.hpp"

namespace swiftlet {
namespace {

constexpr double kMaxRelationS = 24.0 * 3600.0;
constexpr const char* kRemedy = "say which with --relations or --truth";

Result<ReferenceKind> kind_of(const std::vector<NumberRow>& rows, const std::string& path) {
  const auto earlier = [](const NumberRow& a, const NumberRow& b) { return a.value[0] < b.value[0]; };
  const auto [first, last] = std::minmax_element(rows.begin(), rows.end(), earlier);
  const double from_s = first->value[0];
  const double to_s = last->value[0] + kMaxRelationS;
  const auto no_rotation = std::find_if_not(rows.begin(), rows.end(), has_unit_quaternion);
  const auto no_stamp = std::find_if_not(rows.begin(), rows.end(), [&](const NumberRow& row) {
    return row.value[1] >= from_s && row.value[1] <= to_s;
  });
  const bool may_be_truth = no_rotation == rows.end();
  const bool may_be_relations = no_stamp == rows.end();
  if (may_be_truth != may_be_relations)
    return may_be_truth ? ReferenceKind::kTruth : ReferenceKind::kRelations;
  if (may_be_truth)
    return Error{ErrorCode::kInvalidInput,
                 fmt::format("{}: may be relations (two stamps in each line) or a TUM trajectory (a unit "
                             "quaternion in each line); {}",
                             path, kRemedy)};
  return Error{ErrorCode::kInvalidInput,
               fmt::format("{}: neither a TUM trajectory (no unit quaternion in line {}) nor relations (no "
                           "second stamp in line {}); if it is one, {}",
                           path, no_rotation->line, no_stamp->line, kRemedy)};
}

}  // namespace

Result<ReferenceKind> recognise_reference(const std::string& path) {
  const Result<std::uint64_t> size = size_of_input_file(path);
  if (!size) return size.error();
  if (begins_like_capture(path) || path.ends_with(".pcap") || path.ends_with(".pcap.gz"))
    return ReferenceKind::kFlight;
  if (path.ends_with(".relations") || path.ends_with(".relations.gz")) return ReferenceKind::kRelations;
  const Result<std::vector<NumberRow>> rows = read_number_rows(path);
  if (!rows) return rows.error();
  return kind_of(*rows, path);
}

}  // namespace swiftlet
