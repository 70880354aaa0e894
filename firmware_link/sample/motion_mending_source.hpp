// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "core/sensing/heading_leaps.hpp"
#include "core/sensing/quick_restarts.hpp"
#include "firmware_link/sample/forwarding_source.hpp"

namespace swiftlet {

/// Samples of a flying vehicle, live or not, whose estimate may restart and whose heading may leap, mended by
/// QuickRestarts and then by HeadingLeaps. Each leap is an event; how many there were of both is a note of
/// the report once it has ended. next() allocates no more than the vehicle's own.
class MotionMendingSource final : public ForwardingSource {
 public:
  using ForwardingSource::ForwardingSource;

  [[nodiscard]] Result<ReceivedSample> next() override;
  [[nodiscard]] std::optional<VehicleEvent> take_event() override;
  void end() override;
  [[nodiscard]] std::vector<MendedOdometry> mended() const override {
    return mended_in_turn(restarts_.mended(), leaps_.mended());
  }

 private:
  QuickRestarts restarts_;
  HeadingLeaps leaps_;
  std::size_t leaps_told_ = 0;
};

}  // namespace swiftlet
