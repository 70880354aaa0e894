// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <cstdint>

#include "firmware_link/simulation/vehicle.hpp"
#include "tests/support/emulated_crazyradio.hpp"
#include "tests/support/emulated_receiver.hpp"
#include "tests/support/emulated_usb.hpp"
#include "tests/support/scheduled_link_clock.hpp"

namespace swiftlet {

/// A vehicle that gives up its radio after a second of silence, as all do that fly.
inline VehicleModel vehicle_on_radio() {
  VehicleModel model;
  model.link_timeout = kRadioLinkTimeout;
  return model;
}

/// Vehicle, radio chip, dongle and bus in simulated time, wired up. One thread at a time.
struct EmulatedFlight {
  explicit EmulatedFlight(std::uint64_t seed, const VehicleModel& model = vehicle_on_radio(),
                          DongleModel dongle_model = DongleModel::kPa)
      : vehicle(make_simulated_world("office").value(), model, seed),
        receiver(vehicle, seed),
        dongle(receiver, dongle_model) {
    clock.on_step = [this](Duration by) { dongle.advance(by); };
  }
  EmulatedFlight(const EmulatedFlight&) = delete;
  EmulatedFlight& operator=(const EmulatedFlight&) = delete;
  ~EmulatedFlight() = default;

  ScheduledLinkClock clock;
  SimulatedVehicle vehicle;
  EmulatedReceiver receiver;
  EmulatedCrazyradio dongle;
  EmulatedUsbBus bus{dongle, clock};
};

}  // namespace swiftlet
