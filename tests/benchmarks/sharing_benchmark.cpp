// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
// How long a setpoint of a client takes through a shared radio: from the client's send() to the dongle, in
// real time, on the emulated Crazyradio with a simulated vehicle behind it. Prints JSON.
//
// sharing_benchmark [SECONDS]    of each case; 60 unless given

#include <poll.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <span>
#include <string>
#include <thread>
#include <utility>
#include <variant>
#include <vector>

#include "core/base/check.hpp"
#include "tests/support/shared_flight.hpp"

namespace swiftlet {
namespace {

using SteadyTime = std::chrono::steady_clock::time_point;
using std::chrono::milliseconds;
using std::chrono::seconds;

constexpr Duration kSetpointPeriod = milliseconds(10);
constexpr std::size_t kMaxSetpoints = 100'000;

SteadyTime steady_now() { return std::chrono::steady_clock::now(); }

/// When each setpoint was sent by the client, and was first given to the dongle.
class Passages {
 public:
  void sent(std::uint32_t number) { sent_[number] = steady_now(); }
  /// A packet that goes to the dongle; one that is repeated counts once.
  void on_air(std::span<const std::uint8_t> packet) {
    if (packet.size() != 15 || packet[0] >> 4U != 3) return;
    const std::uint32_t number = packet[1] + 256U * packet[2] + 65536U * packet[3];
    if (!passed_.empty() && passed_.back().number == number) return;
    passed_.push_back({number, steady_now()});
  }
  struct Passed {
    std::uint32_t number = 0;
    SteadyTime at{};
  };
  [[nodiscard]] const std::vector<Passed>& passed() const { return passed_; }
  [[nodiscard]] double latency_ms(const Passed& passed) const {
    return std::chrono::duration<double, std::milli>(passed.at - sent_[passed.number]).count();
  }

 private:
  std::vector<SteadyTime> sent_ = std::vector<SteadyTime>(kMaxSetpoints);
  std::vector<Passed> passed_;
};

/// A bus with an ear on what is given to the dongle.
class HeardBus final : public UsbBus {
 public:
  HeardBus(UsbBus& bus, Passages& passages) : bus_(bus), passages_(passages) {}
  std::vector<UsbIdentity> list(std::uint16_t vendor, std::uint16_t product) override {
    return bus_.list(vendor, product);
  }
  std::variant<std::unique_ptr<UsbDevice>, UsbOutcome> open(const UsbIdentity& identity,
                                                            int interface) override {
    auto opened = bus_.open(identity, interface);
    if (std::holds_alternative<UsbOutcome>(opened)) return opened;
    return std::make_unique<Device>(std::get<0>(std::move(opened)), passages_);
  }
  bool has_changed() override { return bus_.has_changed(); }

 private:
  class Device final : public UsbDevice {
   public:
    Device(std::unique_ptr<UsbDevice> device, Passages& passages)
        : device_(std::move(device)), passages_(passages) {}
    UsbTransfer control_out(std::uint8_t request, std::uint16_t value, std::uint16_t index,
                            std::span<const std::uint8_t> data, Duration timeout) override {
      return device_->control_out(request, value, index, data, timeout);
    }
    UsbTransfer bulk_out(std::uint8_t endpoint, std::span<const std::uint8_t> bytes,
                         Duration timeout) override {
      passages_.on_air(bytes);
      return device_->bulk_out(endpoint, bytes, timeout);
    }
    UsbTransfer bulk_in(std::uint8_t endpoint, std::span<std::uint8_t> buffer, Duration timeout) override {
      return device_->bulk_in(endpoint, buffer, timeout);
    }
    UsbOutcome clear_halt(std::uint8_t endpoint) override { return device_->clear_halt(endpoint); }
    UsbOutcome reset() override { return device_->reset(); }

   private:
    std::unique_ptr<UsbDevice> device_;
    Passages& passages_;
  };
  UsbBus& bus_;
  Passages& passages_;
};

/// The simulated time of a flight keeps pace with the machine's.
class PacedFlight {
 public:
  explicit PacedFlight(Passages& passages) : flight_(1), bus_(flight_.bus, passages) {
    const HostTime simulated_start = flight_.clock.now();
    const SteadyTime start = steady_now();
    flight_.clock.on_step = [this, simulated_start, start](Duration by) {
      flight_.dongle.advance(by);
      std::this_thread::sleep_until(start + (flight_.clock.now() - simulated_start));
    };
    auto socket = ClientSocket::open({.host = "127.0.0.1", .port = 0});
    SWIFTLET_CHECK(socket.ok(), "the loopback has a free port");
    auto link = std::make_unique<SharedLink>(std::make_unique<RadioLink>(bus_, flight_.clock, RadioAddress{}),
                                             std::move(*socket), flight_.clock);
    port_ = link->port();
    LinkInput input;
    input.name = "benchmark";
    input.clock = {std::shared_ptr<LinkClock>(), &flight_.clock};
    input.shared = link.get();
    input.link = std::move(link);
    input.starts_logging = true;
    source_ = std::make_unique<LinkSampleSource>(std::move(input));
  }

  [[nodiscard]] std::uint16_t port() const { return port_; }
  /// Whether a sample has come.
  bool step() {
    has_sample_ = source_->next().ok() || has_sample_;
    return has_sample_;
  }
  [[nodiscard]] bool is_connected() const {
    return source_->live_status()->link.condition == LinkCondition::kConnected;
  }
  [[nodiscard]] const InputCounters& counters() const { return source_->report().counters; }

 private:
  EmulatedFlight flight_;
  HeardBus bus_;
  std::uint16_t port_ = 0;
  std::unique_ptr<LinkSampleSource> source_;
  bool has_sample_ = false;
};

/// A client on a thread of its own: a hundred setpoints a second and, if it is to, one table after the other.
class ClientThread {
 public:
  ClientThread(std::uint16_t port, Passages& passages, std::uint32_t first, bool fetches_tables)
      : client_(port),
        passages_(passages),
        next_(first),
        fetches_tables_(fetches_tables),
        thread_([this](const std::stop_token& stop) { run(stop); }) {}

  /// Ends it. The number after its last setpoint.
  std::uint32_t end() {
    thread_.request_stop();
    thread_.join();
    return next_;
  }

 private:
  void run(const std::stop_token& stop) {
    for (SteadyTime due = steady_now(); !stop.stop_requested();) {
      if (fetches_tables_ && client_.is_idle()) client_.ask_for_table(kLogTocTopic);
      client_.step(HostTime(steady_now().time_since_epoch()));
      if (steady_now() >= due) {
        due += kSetpointPeriod;
        send_setpoint();
      }
      const auto left = std::chrono::duration_cast<Duration>(due - steady_now());
      const timespec longest{.tv_sec = 0,
                             .tv_nsec = std::clamp(left, Duration::zero(), kSetpointPeriod).count()};
      pollfd watched{.fd = client_.file(), .events = POLLIN, .revents = 0};
      static_cast<void>(::ppoll(&watched, 1, &longest, nullptr));
    }
  }
  void send_setpoint() {
    const std::array<std::uint8_t, 15> packet{0x3C, low_byte(next_), high_byte(next_),
                                              low_byte(next_ >> 16U)};
    passages_.sent(next_++);
    client_.send(packet);
  }

  FlightClient client_;
  Passages& passages_;
  std::uint32_t next_;
  bool fetches_tables_;
  std::jthread thread_;
};

void print_case(const char* name, const Passages& passages, std::uint32_t sent, std::uint64_t gaps,
                bool is_last) {
  std::vector<double> latencies_ms;
  std::uint32_t reordered = 0;
  for (std::size_t i = 0; i < passages.passed().size(); ++i) {
    latencies_ms.push_back(passages.latency_ms(passages.passed()[i]));
    if (i > 0 && passages.passed()[i].number < passages.passed()[i - 1].number) ++reordered;
  }
  std::ranges::sort(latencies_ms);
  const std::size_t count = latencies_ms.size();
  const auto quantile = [&](std::size_t percent) {
    return count == 0 ? 0.0 : latencies_ms[std::min(count - 1, count * percent / 100)];
  };
  std::printf(
      "  {\"case\": \"%s\", \"sent\": %u, \"lost\": %ld, \"reordered\": %u, \"p50_ms\": %.3f, \"p99_ms\": "
      "%.3f, "
      "\"max_ms\": %.3f, \"gaps\": %lu}%s\n",
      name, sent, static_cast<long>(sent) - static_cast<long>(count), reordered, quantile(50), quantile(99),
      count == 0 ? 0.0 : latencies_ms.back(), static_cast<unsigned long>(gaps), is_last ? "" : ",");
}

/// With samples at 10 Hz throughout.
void measure_flight(const char* name, Duration duration, bool fetches_tables) {
  Passages passages;
  PacedFlight flight(passages);
  while (!flight.step()) continue;
  ClientThread client(flight.port(), passages, 0, fetches_tables);
  for (const SteadyTime end = steady_now() + duration; steady_now() < end;) static_cast<void>(flight.step());
  const std::uint32_t sent = client.end();
  for (const SteadyTime end = steady_now() + milliseconds(200); steady_now() < end;)
    static_cast<void>(flight.step());
  print_case(name, passages, sent, flight.counters().gaps, false);
}

/// While swiftlet itself downloads the log's table, again and again.
void measure_handshakes(const char* name, Duration duration) {
  Passages passages;
  std::uint32_t sent = 0;
  for (const SteadyTime end = steady_now() + duration; steady_now() < end;) {
    PacedFlight flight(passages);
    while (!flight.is_connected()) static_cast<void>(flight.step());
    ClientThread client(flight.port(), passages, sent, false);
    while (!flight.step()) continue;
    sent = client.end();
    for (const SteadyTime last = steady_now() + milliseconds(50); steady_now() < last;)
      static_cast<void>(flight.step());
  }
  print_case(name, passages, sent, 0, true);
}

}  // namespace
}  // namespace swiftlet

int main(int argc, char** argv) {
  const swiftlet::Duration duration = std::chrono::seconds(argc > 1 ? std::atoi(argv[1]) : 60);
  std::printf("[\n");
  swiftlet::measure_flight("swiftlet logs at 10 Hz", duration, false);
  swiftlet::measure_flight("the client downloads tables of contents, too", duration, true);
  swiftlet::measure_handshakes("swiftlet downloads its table of contents", duration);
  std::printf("]\n");
}
