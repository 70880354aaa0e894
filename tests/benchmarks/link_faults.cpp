// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
// The daemon on a simulated vehicle behind a relay that loses, doubles, delays and damages datagrams, over
// UDP on the loopback, in simulated time. Prints what became of the flight as JSON.
//
// link_faults SECONDS [FAULT=VALUE]...    of flight after take-off; the faults are those of RelayFaults

#include <poll.h>
#include <spdlog/sinks/stdout_sinks.h>
#include <spdlog/spdlog.h>

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <stop_token>
#include <string>
#include <thread>
#include <utility>

#include "core/base/check.hpp"
#include "daemon/daemon.hpp"
#include "daemon/outputs/run_outputs.hpp"
#include "firmware_link/input/link_sample_source.hpp"
#include "firmware_link/link/udp_link.hpp"
#include "firmware_link/simulation/sensor_errors.hpp"
#include "firmware_link/simulation/udp_server.hpp"
#include "tests/benchmarks/fault_relay.hpp"
#include "tests/support/scheduled_link_clock.hpp"

namespace swiftlet {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* kWorld = "office";
constexpr std::uint64_t kSeed = 1;
constexpr Duration kLongestConnection = std::chrono::seconds(120);
constexpr Duration kStep = std::chrono::milliseconds(1);

VehicleModel model_in(const SimulatedWorld& world) {
  VehicleModel model = vehicle_model_in(world, kSeed);
  model.link_timeout = kRadioLinkTimeout;
  return model;
}

/// A vehicle on the loopback and the relay before it, in the time of whoever waits for them: the radio
/// thread.
class FaultyFlight {
 public:
  /// `run_end` is asked to stop when the vehicle has flown that long, or does not take off.
  FaultyFlight(Duration flight, const RelayFaults& faults, std::stop_source& run_end)
      : flight_(flight),
        run_end_(run_end),
        began_at_(clock_.now()),
        vehicle_(world(), model_in(world()), kSeed),
        server_(std::move(SimulatedUdpServer::open("127.0.0.1", 0, vehicle_, clock_, kSeed)).value()),
        relay_(server_port(), faults, kSeed) {
    clock_.on_step = [this](Duration /*by*/) { step(); };
  }
  FaultyFlight(const FaultyFlight&) = delete;
  FaultyFlight& operator=(const FaultyFlight&) = delete;
  ~FaultyFlight() = default;

  [[nodiscard]] ScheduledLinkClock& clock() { return clock_; }
  [[nodiscard]] SimulatedVehicle& vehicle() { return vehicle_; }
  [[nodiscard]] const FaultRelay& relay() const { return relay_; }
  /// From the first request to take-off; negative: it did not take off.
  [[nodiscard]] double connected_s() const {
    return took_off_at_ ? to_seconds(*took_off_at_ - began_at_) : -1.0;
  }

 private:
  static SimulatedWorld world() { return make_simulated_world(kWorld, kSeed).value(); }
  [[nodiscard]] std::uint16_t server_port() const {
    const std::string address = server_->address();
    return static_cast<std::uint16_t>(std::stoi(address.substr(address.rfind(':') + 1)));
  }
  void step() {
    const HostTime now = clock_.now();
    if (now - served_at_ < kStep) return;
    served_at_ = now;
    relay_.serve(now);
    server_->serve();
    relay_.serve(now);
    if (!took_off_at_ && vehicle_.is_flying()) took_off_at_ = now;
    const HostTime end = took_off_at_ ? *took_off_at_ + flight_ : began_at_ + kLongestConnection;
    if (now >= end) run_end_.request_stop();
  }

  Duration flight_;
  std::stop_source& run_end_;
  ScheduledLinkClock clock_;
  HostTime began_at_;
  HostTime served_at_{};
  std::optional<HostTime> took_off_at_;
  SimulatedVehicle vehicle_;
  std::unique_ptr<SimulatedUdpServer> server_;
  FaultRelay relay_;
};

/// Counts what the daemon would publish.
class CountingPublisher final : public Publisher {
 public:
  void publish_pose(const PoseUpdate& /*pose*/) override { ++poses; }
  std::uint64_t poses = 0;
};

/// Times of the samples, of which none must come twice.
struct SampleTimes {
  std::set<DeviceTime> seen;
  std::uint64_t doubled = 0;
  void add(DeviceTime at) {
    if (!seen.insert(at).second) ++doubled;
  }
};

LinkInput input_for(FaultyFlight& flight, SampleTimes& times) {
  LinkInput input;
  input.name = "udp://127.0.0.1:" + std::to_string(flight.relay().port());
  input.clock = std::shared_ptr<LinkClock>(&flight.clock(), [](LinkClock*) {});
  input.link = std::move(UdpLink::open("127.0.0.1", flight.relay().port(), *input.clock)).value();
  input.starts_logging = true;
  input.truth = KnownTruth{[&flight, &times](DeviceTime at) {
                             times.add(at);
                             return flight.vehicle().T_world_body(at);
                           },
                           std::move(PoseFile::open()).value()};
  return input;
}

/// Simulated time has no use for the pauses of the radio thread, a millisecond of real time each.
class HurriedClock final : public Clock {
 public:
  [[nodiscard]] MonotonicTime now() const override { return steady_.now(); }
  void sleep_until(MonotonicTime /*wake_at*/) override {
    std::this_thread::sleep_for(std::chrono::microseconds(20));
  }
  void wait_for(EventCount& event_count, std::uint32_t received, MonotonicTime wake_at) override {
    steady_.wait_for(event_count, received, wake_at);
  }

 private:
  SteadyClock steady_;
};

Json error_json(const Daemon& daemon, const LinkSampleSource& source) {
  const std::optional<RunError> error = run_error({.backend = daemon.pipeline().backend(),
                                                   .map = daemon.pipeline().map(),
                                                   .input = source.report(),
                                                   .frontend = daemon.pipeline().frontend().counters(),
                                                   .timing = daemon.pipeline().timing(),
                                                   .truth = source.ground_truth(),
                                                   .input_uri = {},
                                                   .sensor = source.sensor()});
  if (!error) return nullptr;
  return {{"odometry_m", error->odometry.rmse_m},
          {"live_m", error->live.rmse_m},
          {"corrected_m", error->corrected.rmse_m},
          {"largest_m", error->corrected.max_m}};
}

Json result_of(const Daemon& daemon, const LinkSampleSource& source, const FaultyFlight& flight,
               const SampleTimes& times, std::uint64_t poses) {
  const InputCounters& counters = source.report().counters;
  return {{"connected_s", flight.connected_s()},
          {"samples", counters.samples},
          {"doubled_samples", times.doubled},
          {"duplicates", counters.duplicates},
          {"out_of_order", counters.out_of_order},
          {"missing_packets", counters.missing_packets},
          {"gaps", counters.gaps},
          {"segments", counters.segments},
          {"silences", source.live_status()->link.silences},
          {"poses", poses},
          {"garbage", flight.relay().garbage_sent()},
          {"error", error_json(daemon, source)},
          {"notes", source.report().notes},
          {"problems", source.report().problems}};
}

int run(Duration duration, const RelayFaults& faults) {
  std::stop_source run_end;
  FaultyFlight flight(duration, faults, run_end);
  SampleTimes times;
  LinkSampleSource source(input_for(flight, times));
  const Configuration config;
  HurriedClock clock;
  CountingPublisher publisher;
  // Simulated time waits for the frontend.
  Daemon daemon(config, source, clock, {.rate = {}, .refuses_when_full = false}, publisher);
  const Status outcome = daemon.run(run_end.get_token());
  Json result = result_of(daemon, source, flight, times, publisher.poses);
  result["outcome"] = outcome ? "ended" : outcome.error().message;
  std::printf("%s\n", result.dump(2).c_str());
  return 0;
}

}  // namespace
}  // namespace swiftlet

int main(int argc, char** argv) {
  spdlog::set_default_logger(spdlog::stderr_logger_mt("link_faults"));
  swiftlet::RelayFaults faults;
  const double seconds = argc > 1 ? std::strtod(argv[1], nullptr) : 0.0;
  bool is_understood = seconds > 0.0;
  for (int i = 2; i < argc; ++i) is_understood = faults.set(argv[i]) && is_understood;
  if (is_understood) return swiftlet::run(swiftlet::from_seconds(seconds), faults);
  std::fputs("usage: link_faults SECONDS [FAULT=VALUE]...\n", stderr);
  return 2;
}
