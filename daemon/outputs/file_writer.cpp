// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "daemon/outputs/file_writer.hpp"

#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <string>
#include <system_error>

namespace swiftlet {

namespace fs = std::filesystem;

namespace {

/// True when all bytes have reached the disk.
bool write_all(const fs::path& path, std::string_view bytes) {
  std::FILE* file = std::fopen(path.c_str(), "wb");
  if (file == nullptr) return false;
  const bool written = std::fwrite(bytes.data(), 1, bytes.size(), file) == bytes.size() &&
                       std::fflush(file) == 0 && ::fsync(::fileno(file)) == 0;
  const int write_errno = errno;
  const bool closed = std::fclose(file) == 0;
  if (!written) errno = write_errno;
  return written && closed;
}

}  // namespace

Status prepare_output_directory(const fs::path& directory) {
  std::error_code failure;
  fs::create_directories(directory, failure);
  if (!failure && !fs::is_directory(directory, failure))
    failure = std::make_error_code(std::errc::not_a_directory);
  if (!failure && ::access(directory.c_str(), W_OK | X_OK) != 0)
    failure = std::error_code(errno, std::generic_category());
  if (!failure) return {};
  return Error{ErrorCode::kInvalidInput, "output directory " + directory.string() + " cannot be written: " +
                                             failure.message() + "; name another one"};
}

Status write_file(const fs::path& path, std::string_view bytes) {
  const fs::path unfinished = path.string() + ".unfinished";
  std::error_code failure;
  if (!write_all(unfinished, bytes)) {
    failure = std::error_code(errno, std::generic_category());
  } else {
    fs::rename(unfinished, path, failure);
  }
  if (!failure) return {};
  std::error_code ignored;
  fs::remove(unfinished, ignored);
  return Error{ErrorCode::kOutOfSpace, path.string() + " was not written: " + failure.message()};
}

}  // namespace swiftlet
