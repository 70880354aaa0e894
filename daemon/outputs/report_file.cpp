// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "daemon/outputs/report_file.hpp"

#include <cstdint>
#include <fstream>

#include "firmware_link/file/input_file.hpp"

namespace swiftlet {

Result<nlohmann::ordered_json> read_report(const std::filesystem::path& file) {
  if (const Result<std::uint64_t> size = size_of_input_file(file.string()); !size) return size.error();
  std::ifstream stream(file);
  return nlohmann::ordered_json::parse(stream, nullptr, false);
}

}  // namespace swiftlet
