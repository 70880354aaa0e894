// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "tools/progress_bar.hpp"

#include <unistd.h>

#include <algorithm>
#include <cmath>

namespace swiftlet {

namespace {

constexpr int kBarWidth = 40;
constexpr auto kRedrawPeriod = std::chrono::milliseconds(100);

}  // namespace

std::string progress_text(double fraction, std::chrono::duration<double> elapsed, int width) {
  const double done = std::clamp(fraction, 0.0, 1.0);
  const int filled = static_cast<int>(std::lround(done * width));
  std::string text = "[";
  text.append(static_cast<std::size_t>(filled), '#').append(static_cast<std::size_t>(width - filled), '.');
  text.append("] ").append(std::to_string(static_cast<int>(done * 100.0))).append(" %");
  if (done < 0.01) return text;
  const auto seconds_left = std::lround(elapsed.count() * (1.0 - done) / done);
  const std::string rest = std::to_string(seconds_left % 60);
  return text + ", " + std::to_string(seconds_left / 60) + ":" + (rest.size() < 2 ? "0" : "") + rest +
         " left";
}

ProgressBar::ProgressBar(std::FILE* stream, Clock::time_point start)
    : stream_(::isatty(::fileno(stream)) == 1 ? stream : nullptr), start_(start), next_draw_(start) {}

ProgressBar::~ProgressBar() {
  if (stream_ == nullptr) return;
  std::fputs(kBackToEmptyLine, stream_);
  std::fflush(stream_);
}

void ProgressBar::update(std::optional<double> fraction, Clock::time_point now) {
  if (stream_ == nullptr || !fraction || now < next_draw_) return;
  next_draw_ = now + kRedrawPeriod;
  const std::string line = kBackToEmptyLine + progress_text(*fraction, now - start_, kBarWidth);
  std::fputs(line.c_str(), stream_);
  std::fflush(stream_);
}

}  // namespace swiftlet
