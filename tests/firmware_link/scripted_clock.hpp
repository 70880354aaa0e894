// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include "firmware_link/link/link_clock.hpp"
#include "tests/firmware_link/scripted_vehicle.hpp"

namespace swiftlet {

/// Shows the time of a scripted link, which must outlive it.
class ScriptedClock final : public LinkClock {
 public:
  explicit ScriptedClock(const ScriptedLink& link) : link_(link) {}
  HostTime now() override { return host_ms(link_.now_ms); }
  void sleep_for(Duration /*duration*/) override {}

 private:
  const ScriptedLink& link_;
};

}  // namespace swiftlet
