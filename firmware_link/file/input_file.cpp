// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "firmware_link/file/input_file.hpp"

#include <zlib.h>

#include <algorithm>
#include <array>
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
    return Error{ErrorCode::kInvalidInput, path + ": is a directory; name a file in it"};
  if (status.type() != std::filesystem::file_type::regular)
    return Error{ErrorCode::kInvalidInput, path + ": is not a regular file"};
  const std::uintmax_t size = std::filesystem::file_size(path, error);
  if (error) return Error{ErrorCode::kInvalidInput, path + ": " + error.message()};
  if (size == 0) return Error{ErrorCode::kInvalidInput, path + ": is empty"};
  if (!std::ifstream(path)) return Error{ErrorCode::kInvalidInput, path + ": cannot be read (permission?)"};
  return std::uint64_t{size};
}

bool begins_like_capture(const std::string& path) {
  std::array<char, 4> start{};
  const gzFile file = gzopen(path.c_str(), "rb");  // reads plain files, too
  if (file == nullptr) return false;
  static_cast<void>(gzread(file, start.data(), static_cast<unsigned>(start.size())));
  static_cast<void>(gzclose_r(file));
  constexpr std::array<std::array<char, 4>, 5> kStarts{{{'\xD4', '\xC3', '\xB2', '\xA1'},
                                                        {'\xA1', '\xB2', '\xC3', '\xD4'},
                                                        {'\x4D', '\x3C', '\xB2', '\xA1'},
                                                        {'\xA1', '\xB2', '\x3C', '\x4D'},
                                                        {'\x0A', '\x0D', '\x0D', '\x0A'}}};  // pcapng
  return std::find(kStarts.begin(), kStarts.end(), start) != kStarts.end();
}

}  // namespace swiftlet
