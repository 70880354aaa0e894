// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include "firmware_link/link/link.hpp"

namespace swiftlet {

/// Takes every frame that a sample source receives or sends, in order: what a replay needs.
class FrameSink {
 public:
  FrameSink() = default;
  virtual ~FrameSink() = default;
  FrameSink(const FrameSink&) = delete;
  FrameSink& operator=(const FrameSink&) = delete;

  /// Called on the radio thread: must not wait, allocate or throw.
  virtual void take(const LinkFrame& frame) noexcept = 0;
};

}  // namespace swiftlet
