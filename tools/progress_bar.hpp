// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <chrono>
#include <cstdio>
#include <optional>
#include <string>

namespace swiftlet {

/// Empties the line of a terminal.
inline constexpr const char* kBackToEmptyLine = "\r\x1b[K";

/// "[#####.....] 52 %, 0:07 left" with a bar of `width` characters; the time left is a guess from the pace so
/// far and left out before 1 %.
[[nodiscard]] std::string progress_text(double fraction, std::chrono::duration<double> elapsed, int width);

/// One line on a terminal that shows how far a run has come; gone when the bar is.
class ProgressBar {
 public:
  using Clock = std::chrono::steady_clock;

  /// Nothing is ever written where `stream` is not a terminal. `stream` must outlive the bar.
  ProgressBar(std::FILE* stream, Clock::time_point start);
  ~ProgressBar();
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  /// `fraction` 0 to 1, nullopt when the end is unknown. Cheap: redraws ten times a second at most.
  void update(std::optional<double> fraction, Clock::time_point now);

 private:
  std::FILE* stream_;  ///< null: stay silent
  Clock::time_point start_;
  Clock::time_point next_draw_;
};

}  // namespace swiftlet
