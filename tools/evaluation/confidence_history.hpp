// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <span>
#include <vector>

#include "core/backend/backend.hpp"
#include "core/evaluation/consistency.hpp"

namespace swiftlet {

/// Keeps what a run publishes of its confidence with each sample. Views the backend, which must outlive it.
/// Allocates: 180 bytes a sample.
class ConfidenceHistory {
 public:
  explicit ConfidenceHistory(Backend& backend) : backend_(&backend) {}

  /// After each sample, until the final pass.
  void look();
  [[nodiscard]] std::span<const DoubtedPose> poses() const { return poses_; }

 private:
  Backend* backend_;
  ScanId seen_{};
  PoseConfidence newest_;
  std::vector<DoubtedPose> poses_;
};

}  // namespace swiftlet
