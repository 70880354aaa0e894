// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "daemon/outputs/png_file.hpp"

#include <png.h>

#include <cerrno>
#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <system_error>

namespace swiftlet {

namespace {

/// What is written to its stream lies in memory, and takes as much of it as was written: a picture is many
/// times smaller encoded than the room that libpng asks for when it shall write to memory itself.
class MemoryFile {
 public:
  MemoryFile() : stream_(::open_memstream(&bytes_, &size_)) {}
  ~MemoryFile() {
    if (stream_ != nullptr) static_cast<void>(std::fclose(stream_));
    std::free(bytes_);  // NOLINT(cppcoreguidelines-no-malloc): as open_memstream() demands
  }
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;

  /// nullptr: could not be opened, errno has the reason.
  [[nodiscard]] std::FILE* stream() { return stream_; }
  /// All that was flushed.
  [[nodiscard]] std::string bytes() const { return {bytes_, size_}; }

 private:
  char* bytes_ = nullptr;
  std::size_t size_ = 0;
  std::FILE* stream_;
};

Error not_encoded(const std::string& why) {
  return {ErrorCode::kOutOfSpace, "the picture was not encoded: " + why};
}

}  // namespace

Result<std::string> encode_png(const RgbImage& image) {
  static_assert(sizeof(Colour) == 3, "libpng reads three bytes a pixel");
  MemoryFile file;
  if (file.stream() == nullptr) return not_encoded(std::generic_category().message(errno));
  png_image header{};
  header.version = PNG_IMAGE_VERSION;
  header.width = static_cast<png_uint_32>(image.width());
  header.height = static_cast<png_uint_32>(image.height());
  header.format = PNG_FORMAT_RGB;
  if (png_image_write_to_stdio(&header, file.stream(), 0, image.pixels().data(), 0, nullptr) == 0)
    return not_encoded(header.message);
  if (std::fflush(file.stream()) != 0) return not_encoded(std::generic_category().message(errno));
  return file.bytes();
}

}  // namespace swiftlet
