// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <algorithm>
#include <cstdlib>
#include <string>
#include <string_view>

namespace swiftlet {

/// For each of the `name` and `name=value`, separated by single blanks, calls `take(name, value)`; the value
/// is 0 where none is given.
template <typename Take>
void for_each_member(std::string_view members, Take take) {
  while (!members.empty()) {
    const std::string_view member = members.substr(0, members.find(' '));
    members.remove_prefix(std::min(member.size() + 1, members.size()));
    const std::string_view name = member.substr(0, member.find('='));
    const std::string value(member.substr(std::min(name.size() + 1, member.size())));
    take(name, std::strtod(value.c_str(), nullptr));
  }
}

}  // namespace swiftlet
