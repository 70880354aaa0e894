// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "firmware_link/input_file.hpp"

#include <filesystem>
#include <fstream>
#include <system_error>

namespace swiftlet {

Result<std::uint64_t> size_of_input_file(const std::string& path) {
  std::error_code error;
  const std::filesystem::file_status status = std::filesystem::status(path, error);
  if (status.type() == std::filesystem::file_type::not_found)
    return Error{ErrorCode::kNotFound, path + ": no such file"};
  if (error) return Error{ErrorCode::kInvalidInput, path + ": " + error.message()};
  if (status.type() == std::filesystem::file_type::directory)
    return Error{ErrorCode::kInvalidInput, path + ": is a directory; name the recording inside it"};
  if (status.type() != std::filesystem::file_type::regular)
    return Error{ErrorCode::kInvalidInput, path + ": is not a regular file"};
  const std::uintmax_t size = std::filesystem::file_size(path, error);
  if (error) return Error{ErrorCode::kInvalidInput, path + ": " + error.message()};
  if (size == 0) return Error{ErrorCode::kInvalidInput, path + ": is empty"};
  if (!std::ifstream(path)) return Error{ErrorCode::kInvalidInput, path + ": cannot be read (permission?)"};
  return std::uint64_t{size};
}

}  // namespace swiftlet
