// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <chrono>

#include "firmware_link/link/link_clock.hpp"

namespace swiftlet {

/// Time that passes only when someone sleeps or a simulated device takes its time.
class ManualLinkClock final : public LinkClock {
 public:
  HostTime now() override { return now_; }
  void sleep_for(Duration duration) override { now_ += duration; }

 private:
  HostTime now_{std::chrono::seconds(1'767'225'600)};
};

}  // namespace swiftlet
