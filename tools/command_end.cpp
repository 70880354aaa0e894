// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "tools/command_end.hpp"

#include <cstddef>
#include <cstdio>

namespace swiftlet {

void print_note(const std::string& note) { std::fprintf(stderr, "swiftlet: note: %s\n", note.c_str()); }

Status damage_of(const InputReport& report) {
  if (report.problems.empty()) return {};
  std::string message = report.problems.front();
  for (std::size_t i = 1; i < report.problems.size(); ++i) message += "; " + report.problems[i];
  return Error{ErrorCode::kDamaged, message};
}

Status conclude(const Status& written, const InputReport& input) {
  for (const std::string& note : input.notes) print_note(note);
  Status damage = damage_of(input);
  if (written) return damage;
  if (damage) return written;
  return Error{written.error().code, written.error().message + "; " + damage.error().message};
}

}  // namespace swiftlet
