// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "core/base/check.hpp"
#include "firmware_link/input/link_sample_source.hpp"
#include "firmware_link/link/radio_link.hpp"
#include "firmware_link/sharing/client_socket.hpp"
#include "firmware_link/sharing/shared_link.hpp"
#include "tests/support/emulated_flight.hpp"
#include "tests/support/flight_client.hpp"

namespace swiftlet {

/// One emulated Crazyradio in simulated time, shared: samples for the map, and clients on the loopback. One
/// thread.
class SharedFlight {
 public:
  explicit SharedFlight(std::uint64_t seed = 1, const VehicleModel& model = vehicle_on_radio(),
                        FrameSink* recording = nullptr)
      : flight(seed, model) {
    auto socket = ClientSocket::open({.host = "127.0.0.1", .port = 0});
    SWIFTLET_CHECK(socket.ok(), "the loopback has a free port");
    auto link =
        std::make_unique<SharedLink>(std::make_unique<RadioLink>(flight.bus, flight.clock, RadioAddress{}),
                                     std::move(*socket), flight.clock);
    port = link->port();
    LinkInput input;
    input.name = "radio://0/80/2M/E7E7E7E7E7";
    input.clock = {std::shared_ptr<LinkClock>(), &flight.clock};  // the flight's own
    input.shared = link.get();
    input.link = std::move(link);
    input.starts_logging = true;
    input.recording = recording;
    source = std::make_unique<LinkSampleSource>(std::move(input));
  }

  /// A client that lives from now on.
  FlightClient& add_client() {
    clients.push_back(std::make_unique<FlightClient>(port));
    if (clients.size() == 1) tick();
    return *clients.back();
  }
  /// Takes the samples that come within that time, or until `done`.
  void fly(Duration duration, const std::function<bool()>& done = {}) {
    const HostTime end = flight.clock.now() + duration;
    while (flight.clock.now() < end && !(done && done())) {
      const Result<ReceivedSample> received = source->next();
      if (received) samples.push_back(received->sample);
      while (const std::optional<VehicleEvent> event = source->take_event()) events.push_back(*event);
    }
  }
  /// Calls it that often.
  void every(Duration period, std::function<void()> action) {
    flight.clock.after(period, [this, period, action] {
      action();
      every(period, action);
    });
  }

  EmulatedFlight flight;
  std::uint16_t port = 0;
  std::unique_ptr<LinkSampleSource> source;
  std::vector<std::unique_ptr<FlightClient>> clients;
  std::vector<RangeSample> samples;
  std::vector<VehicleEvent> events;

 private:
  void tick() {
    for (const std::unique_ptr<FlightClient>& client : clients)
      if (client) client->step(flight.clock.now());
    flight.clock.after(std::chrono::milliseconds(1), [this] { tick(); });
  }
};

}  // namespace swiftlet
