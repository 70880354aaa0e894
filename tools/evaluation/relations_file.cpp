// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "tools/evaluation/relations_file.hpp"

#include "tools/evaluation/number_rows.hpp"

namespace swiftlet {

Result<std::vector<Relation>> read_relations_file(const std::string& path) {
  const Result<std::vector<NumberRow>> rows = read_number_rows(path);
  if (!rows) return rows.error();
  std::vector<Relation> relations;
  relations.reserve(rows->size());
  for (const NumberRow& row : *rows) {
    const Result<HostTime> first = stamp_in(row, 0, path);
    if (!first) return first.error();
    const Result<HostTime> second = stamp_in(row, 1, path);
    if (!second) return second.error();
    relations.push_back({*first, *second, Pose2(row.value[2], row.value[3], row.value[7])});
  }
  return relations;
}

}  // namespace swiftlet
