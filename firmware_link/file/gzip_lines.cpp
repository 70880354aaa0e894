// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "firmware_link/file/gzip_lines.hpp"

#include <zlib.h>

#include <algorithm>
#include <cstring>

#include "firmware_link/file/gzip_file.hpp"
#include "firmware_link/file/input_file.hpp"

namespace swiftlet {
namespace {

constexpr std::size_t kLongestLine = std::size_t{16} << 20U;
constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";  // spreadsheets begin UTF-8 with it

gzFile gzip_file(void* file) { return static_cast<gzFile>(file); }

}  // namespace

void GzipLines::Close::operator()(void* file) const { gzclose_r(gzip_file(file)); }

Result<GzipLines> GzipLines::open(const std::string& path) {
  const Result<std::uint64_t> size = size_of_input_file(path);
  if (!size) return size.error();
  GzipLines lines;
  lines.path_ = path;
  lines.file_.reset(gzopen(path.c_str(), "rb"));
  if (!lines.file_) return Error{ErrorCode::kInvalidInput, path + ": cannot be read"};
  lines.buffer_.resize(kUnpackedChunk);
  return lines;
}

Result<std::string_view> GzipLines::next() {
  std::size_t searched = begin_;
  for (;;) {
    const char* text = buffer_.data();
    const char* line_end = std::find(text + searched, text + end_, '\n');
    const bool complete = line_end != text + end_;
    const std::size_t waiting = end_ - begin_;
    if (!complete && waiting > kLongestLine)
      return Error{ErrorCode::kDamaged, path_ + ": line " + std::to_string(line_number_ + 1) +
                                            " is longer than 16 MB; what precedes it is used"};
    if (complete || !fill()) {
      if (!complete && (waiting == 0 || damaged_)) return end_error();
      text = buffer_.data();
      std::string_view line(text + begin_,
                            complete ? static_cast<std::size_t>(line_end - text) - begin_ : waiting);
      begin_ += line.size() + (complete ? 1 : 0);
      if (line.ends_with('\r')) line.remove_suffix(1);
      if (line_number_ == 0 && line.starts_with(kByteOrderMark)) line.remove_prefix(kByteOrderMark.size());
      ++line_number_;
      return line;
    }
    searched = begin_ + waiting;
  }
}

bool GzipLines::fill() {
  if (damaged_) return false;
  std::memmove(buffer_.data(), buffer_.data() + begin_, end_ - begin_);
  end_ -= begin_;
  begin_ = 0;
  if (buffer_.size() - end_ < kUnpackedChunk) buffer_.resize(end_ + kUnpackedChunk);
  const int got =
      gzread(gzip_file(file_.get()), buffer_.data() + end_, static_cast<unsigned>(kUnpackedChunk));
  if (got > 0) end_ += static_cast<std::size_t>(got);
  if (got > 0) return true;
  int code = Z_OK;
  gzerror(gzip_file(file_.get()), &code);
  damaged_ = code != Z_OK && code != Z_STREAM_END;
  return false;
}

Error GzipLines::end_error() const {
  if (!damaged_) return {ErrorCode::kEndOfRecording, path_ + ": end of the log"};
  return {ErrorCode::kDamaged, path_ + ": damaged before byte " +
                                   std::to_string(gzoffset(gzip_file(file_.get()))) +
                                   ": the gzip stream is cut off or garbled; what precedes it is used"};
}

}  // namespace swiftlet
