// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "daemon/outputs/png_file.hpp"

#include <png.h>

namespace swiftlet {

Result<std::string> encode_png(const RgbImage& image) {
  static_assert(sizeof(Colour) == 3, "libpng reads three bytes a pixel");
  png_image header{};
  header.version = PNG_IMAGE_VERSION;
  header.width = static_cast<png_uint_32>(image.width());
  header.height = static_cast<png_uint_32>(image.height());
  header.format = PNG_FORMAT_RGB;
  std::string bytes(PNG_IMAGE_PNG_SIZE_MAX(header), '\0');
  png_alloc_size_t size = bytes.size();
  if (png_image_write_to_memory(&header, bytes.data(), &size, 0, image.pixels().data(), 0, nullptr) == 0)
    return Error{ErrorCode::kOutOfSpace, std::string("the picture was not encoded: ") + header.message};
  bytes.resize(size);
  return bytes;
}

}  // namespace swiftlet
