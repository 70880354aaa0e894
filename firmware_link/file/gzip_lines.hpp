// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/result.hpp"

namespace swiftlet {

/// The lines of a text file, plain or gzip (detected by content), without a byte order mark of UTF-8. One
/// thread at a time.
class GzipLines {
 public:
  /// Errors: as size_of_input_file.
  [[nodiscard]] static Result<GzipLines> open(const std::string& path);

  /// The next line without its end; valid until the next call. Errors: kEndOfRecording. kDamaged: the gzip
  /// stream is truncated or corrupt, or a line is longer than 16 MB; the message names the byte offset in the
  /// file, or the line. The lines before it were delivered, a truncated line was not.
  [[nodiscard]] Result<std::string_view> next();
  /// The number of the line that next() returned last, from 1.
  [[nodiscard]] std::uint64_t line_number() const { return line_number_; }

 private:
  struct Close {
    void operator()(void* file) const;
  };
  GzipLines() = default;
  /// False at the end or at damage.
  bool fill();
  [[nodiscard]] Error end_error() const;

  std::string path_;
  std::unique_ptr<void, Close> file_;  // gzFile
  std::vector<char> buffer_;
  std::size_t begin_ = 0;  // of the text not yet delivered
  std::size_t end_ = 0;
  bool damaged_ = false;
  std::uint64_t line_number_ = 0;
};

}  // namespace swiftlet
