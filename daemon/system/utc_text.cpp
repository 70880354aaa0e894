// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "daemon/system/utc_text.hpp"

#include <array>
#include <chrono>
#include <ctime>

namespace swiftlet {

std::string utc_text(HostTime at, const char* form) {
  const auto seconds =
      static_cast<std::time_t>(std::chrono::floor<std::chrono::seconds>(at.time_since_epoch()).count());
  std::tm utc{};
  gmtime_r(&seconds, &utc);
  std::array<char, 32> text{};
  return {text.data(), std::strftime(text.data(), text.size(), form, &utc)};
}

}  // namespace swiftlet
