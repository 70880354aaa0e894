// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "daemon/outputs/file_writer.hpp"

#include <unistd.h>

#include <cerrno>
#include <cstdint>
#include <cstdio>
#include <string>
#include <system_error>

namespace swiftlet {

namespace fs = std::filesystem;

namespace {

constexpr int kMostUnfinished = 100;
constexpr int kMostLinks = 40;  // as the kernel follows

std::error_code last_failure() { return {errno, std::generic_category()}; }

Error not_written(const fs::path& path, const std::error_code& failure) {
  return {ErrorCode::kOutOfSpace, path.string() + " was not written: " + failure.message()};
}

Error cannot_be_output(const fs::path& file, const std::string& reason) {
  return {ErrorCode::kInvalidInput, file.string() + ": " + reason};
}

/// Where links lead, whether anything is there yet or not.
fs::path target_of(fs::path path) {
  std::error_code failure;
  for (int links = 0; links < kMostLinks && fs::is_symlink(path, failure); ++links)
    path = path.parent_path() / fs::read_symlink(path, failure);
  return path;
}

fs::path folder_of(const fs::path& file) {
  std::error_code failure;
  return fs::absolute(file, failure).parent_path();
}

/// False for a pipe or a device, which is written to as it is.
bool is_replaced(const fs::path& target) {
  std::error_code failure;
  const fs::file_status there = fs::status(target, failure);
  return !fs::exists(there) || fs::is_regular_file(there);
}

/// A file beside `path` that was not there: another program, or an earlier one, may have left some.
Result<fs::path> created_beside(const fs::path& path, std::FILE*& file) {
  for (int i = 0; i < kMostUnfinished; ++i) {
    const fs::path unfinished = path.string() + ".unfinished" + (i == 0 ? "" : std::to_string(i));
    file = std::fopen(unfinished.c_str(), "wbx");
    if (file != nullptr) return unfinished;
    if (errno != EEXIST) return not_written(path, last_failure());
  }
  return Error{ErrorCode::kOutOfSpace, path.string() + " was not written: " + path.string() +
                                           ".unfinished and many like it are there already; remove them"};
}

/// Until all bytes have reached the disk. Closes the file.
Status write_all(std::FILE* file, const fs::path& path, const FileContent& content) {
  int failure = 0;
  Status made = content([&](std::string_view bytes) {
    if (failure == 0 && std::fwrite(bytes.data(), 1, bytes.size(), file) != bytes.size()) failure = errno;
    return failure == 0;
  });
  if (failure == 0 && std::fflush(file) != 0) failure = errno;
  if (failure == 0 && ::fsync(::fileno(file)) != 0 && errno != EINVAL && errno != EROFS) failure = errno;
  if (std::fclose(file) != 0 && failure == 0) failure = errno;
  if (failure != 0) return not_written(path, std::error_code(failure, std::generic_category()));
  return made;
}

/// Into what is no file of bytes: a pipe, a device.
Status write_directly(const fs::path& path, const FileContent& content) {
  std::FILE* file = std::fopen(path.c_str(), "wb");
  if (file == nullptr) return not_written(path, last_failure());
  return write_all(file, path, content);
}

enum class IfItFails : std::uint8_t { kRemove, kKeep };

Status write_beside(const fs::path& path, const FileContent& content, IfItFails then) {
  std::FILE* file = nullptr;
  const Result<fs::path> unfinished = created_beside(path, file);
  if (!unfinished) return unfinished.error();
  Status written = write_all(file, path, content);
  std::error_code failure;
  if (written) {
    fs::rename(*unfinished, path, failure);
    if (!failure) return {};
    written = not_written(path, failure);
  }
  if (then == IfItFails::kKeep && written.error().code == ErrorCode::kOutOfSpace)
    return Error{ErrorCode::kOutOfSpace,
                 written.error().message + "; what came before it is in " + unfinished->string()};
  fs::remove(*unfinished, failure);
  return written;
}

Status write_however(const fs::path& path, const FileContent& content, IfItFails then) {
  const fs::path target = target_of(path);
  return is_replaced(target) ? write_beside(target, content, then) : write_directly(target, content);
}

}  // namespace

Status prepare_output_directory(const fs::path& directory) {
  std::error_code failure;
  fs::create_directories(directory, failure);
  if (!failure && !fs::is_directory(directory, failure))
    failure = std::make_error_code(std::errc::not_a_directory);
  if (!failure && ::access(directory.c_str(), W_OK | X_OK) != 0) failure = last_failure();
  if (!failure) return {};
  return Error{ErrorCode::kInvalidInput, "output directory " + directory.string() + " cannot be written: " +
                                             failure.message() + "; name another one"};
}

Status check_output_file(const fs::path& file, std::span<const fs::path> inputs) {
  std::error_code failure;
  if (file.empty()) return Error{ErrorCode::kInvalidInput, "the output has no name; give it one"};
  if (fs::is_directory(file, failure))
    return cannot_be_output(file, "this is a directory; name a file in it");
  for (const fs::path& input : inputs)
    if (fs::equivalent(file, input, failure))
      return cannot_be_output(file, "this is the input; name another output");
  const fs::path target = target_of(file);
  const fs::path written = is_replaced(target) ? folder_of(target) : target;
  if (written != target && !fs::is_directory(written, failure))
    return cannot_be_output(file, "there is no directory " + written.string());
  if (::access(written.c_str(), W_OK) != 0)
    return cannot_be_output(file, written.string() + " cannot be written: " + last_failure().message());
  return {};
}

Status write_file(const fs::path& path, std::string_view bytes) {
  return write_file(path, [bytes](const FileSink& write) {
    write(bytes);
    return Status();
  });
}

Status write_file(const fs::path& path, const FileContent& content) {
  return write_however(path, content, IfItFails::kRemove);
}

Status record_file(const fs::path& path, const FileContent& content) {
  return write_however(path, content, IfItFails::kKeep);
}

}  // namespace swiftlet
