// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "core/frontend/frontend_config.hpp"

namespace swiftlet {

std::vector<std::string> FrontendConfig::validate() const {
  std::vector<std::string> problems = setting_problems(*this);
  if (problems.empty() && association_keyframes > window_keyframes)
    problems.emplace_back("frontend.association_keyframes must be at most window_keyframes");
  return problems;
}

}  // namespace swiftlet
