// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "core/backend/config/backend_config.hpp"

namespace swiftlet {

std::vector<std::string> BackendConfig::validate() const {
  std::vector<std::string> problems = setting_problems(*this);
  if (problems.empty() && max_kernel_cells % 2 == 0)
    problems.emplace_back("backend.max_kernel_cells must be odd");
  return problems;
}

}  // namespace swiftlet
