// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <cstdio>
#include <memory>
#include <vector>

#include "core/base/result.hpp"
#include "core/geometry/stamped_pose.hpp"

namespace swiftlet {

/// Poses kept on disk, so that memory stays the same however many they are. One thread at a time.
class PoseFile {
 public:
  /// The file lies among the temporary ones without a name and is gone with this object. kInvalidInput: it
  /// cannot be made. Allocates.
  [[nodiscard]] static Result<PoseFile> open();

  /// Writes to the disk now and then; allocates nothing. A failure is remembered.
  void push_back(const StampedPose& pose);
  /// All were written so far.
  [[nodiscard]] bool is_complete() const { return !failed_; }
  /// In the order in which they came; of an incomplete file, what can be read. Allocates.
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
