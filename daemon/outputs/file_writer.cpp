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

Error not_written(const fs::path& path, const std::error_code& failure) {
  return {ErrorCode::kOutOfSpace, path.string() + " was not written: " + failure.message()};
}

/// Writes what will be `path`, until all bytes have reached the disk.
Status write_all(const fs::path& unfinished, const fs::path& path, const FileContent& content) {
  const auto failed = [&] { return not_written(path, std::error_code(errno, std::generic_category())); };
  std::FILE* file = std::fopen(unfinished.c_str(), "wb");
  if (file == nullptr) return failed();
  bool written = true;
  Status made = content([&](std::string_view bytes) {
    written = written && std::fwrite(bytes.data(), 1, bytes.size(), file) == bytes.size();
  });
  written = written && std::fflush(file) == 0 && ::fsync(::fileno(file)) == 0;
  const int write_errno = errno;
  const bool closed = std::fclose(file) == 0;
  if (!written) errno = write_errno;
  if (!written || !closed) return failed();
  return made;
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
  return write_file(path, [bytes](const FileSink& write) {
    write(bytes);
    return Status();
  });
}

Status write_file(const fs::path& path, const FileContent& content) {
  const fs::path unfinished = path.string() + ".unfinished";
  Status written = write_all(unfinished, path, content);
  if (written) {
    std::error_code failure;
    fs::rename(unfinished, path, failure);
    if (!failure) return {};
    written = not_written(path, failure);
  }
  std::error_code ignored;
  fs::remove(unfinished, ignored);
  return written;
}

}  // namespace swiftlet
