// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <cstdio>
#include <memory>
#include <vector>

#include "core/base/result.hpp"
#include "core/geometry/stamped_pose.hpp"

namespace swiftlet {

/// Poses kept on disk, so that memory does not grow with their number. One thread at a time.
class PoseFile {
 public:
  /// The file is a temporary one without a name and disappears with this object. kInvalidInput: it cannot be
  /// created. Allocates.
  [[nodiscard]] static Result<PoseFile> open();

  /// Writes to the disk when its buffer is full; allocates nothing. A failure is remembered.
  void push_back(const StampedPose& pose);
  /// Whether all were written so far.
  [[nodiscard]] bool is_complete() const { return !failed_; }
  /// In the order of push_back(); of an incomplete file, what can be read. Allocates.
  [[nodiscard]] std::vector<StampedPose> read() const;

 private:
  struct CloseFile {
    void operator()(std::FILE* file) const { static_cast<void>(std::fclose(file)); }
  };
  explicit PoseFile(std::FILE* file);

  std::unique_ptr<char[]> buffer_;  // outlives the file
  std::unique_ptr<std::FILE, CloseFile> file_;
  bool failed_ = false;
};

}  // namespace swiftlet
