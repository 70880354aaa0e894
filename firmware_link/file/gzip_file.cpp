// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "firmware_link/file/gzip_file.hpp"

#include <zlib.h>

#include <array>
#include <fstream>
#include <memory>

namespace swiftlet {
namespace {

struct CloseGzip {
  void operator()(gzFile_s* file) const { static_cast<void>(gzclose_r(file)); }
};

}  // namespace

bool begins_like_gzip(const std::string& path) {
  std::array<char, 2> start{};
  std::ifstream file(path, std::ios::binary);
  file.read(start.data(), start.size());
  return start == std::array<char, 2>{'\x1F', '\x8B'};
}

Result<UnpackedFile> unpack_gzip(const std::string& path, std::size_t max_bytes) {
  const std::unique_ptr<gzFile_s, CloseGzip> file(gzopen(path.c_str(), "rb"));
  if (!file) return Error{ErrorCode::kInvalidInput, path + ": cannot be read"};
  UnpackedFile unpacked;
  std::size_t size = 0;
  for (int got = 1; got > 0; size += got > 0 ? static_cast<std::size_t>(got) : 0) {
    if (size > max_bytes)
      return Error{
          ErrorCode::kInvalidInput,
          path + ": unpacks to more than " + std::to_string(max_bytes / 1'000'000) + " MB; unpack it first"};
    unpacked.bytes.resize(size + kUnpackedChunk);
    got = gzread(file.get(), unpacked.bytes.data() + size, static_cast<unsigned>(kUnpackedChunk));
  }
  unpacked.bytes.resize(size);
  int code = Z_OK;
  gzerror(file.get(), &code);
  unpacked.is_damaged = code != Z_OK && code != Z_STREAM_END;
  return unpacked;
}

}  // namespace swiftlet
