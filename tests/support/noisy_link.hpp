// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <random>
#include <span>
#include <utility>

#include "firmware_link/link/link.hpp"

namespace swiftlet {

/// The beginning of another link's flight, with random packets of 1 to 31 bytes between its frames, evenly
/// spaced.
class NoisyLink final : public Link {
 public:
  NoisyLink(std::unique_ptr<Link> link, Duration length, Duration noise_period, std::uint64_t seed)
      : link_(std::move(link)), length_(length), noise_period_(noise_period), random_(seed) {}

  [[nodiscard]] Result<LinkFrame> receive(Duration timeout) override {
    if (!next_) {
      const Result<LinkFrame> frame = link_->receive(timeout);
      if (!frame) return frame;
      next_ = *frame;
      if (!began_at_) began_at_ = noise_at_ = frame->at;
    }
    if (next_->at - *began_at_ > length_) return Error{ErrorCode::kEndOfRecording, "the flight is over"};
    if (noise_at_ < next_->at) return noise_of(std::exchange(noise_at_, noise_at_ + noise_period_));
    return *std::exchange(next_, std::nullopt);
  }
  [[nodiscard]] Status send(std::span<const std::uint8_t> packet) override { return link_->send(packet); }

 private:
  LinkFrame noise_of(HostTime at) {
    LinkFrame frame;
    frame.at = at;
    frame.size = static_cast<std::uint8_t>(1 + random_() % frame.bytes.size());
    for (std::size_t i = 0; i < frame.size; ++i) frame.bytes[i] = static_cast<std::uint8_t>(random_());
    return frame;
  }

  std::unique_ptr<Link> link_;
  Duration length_;
  Duration noise_period_;
  std::mt19937_64 random_;
  std::optional<HostTime> began_at_;
  HostTime noise_at_{};
  std::optional<LinkFrame> next_;
};

}  // namespace swiftlet
