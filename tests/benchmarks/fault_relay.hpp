// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <netinet/in.h>

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <queue>
#include <random>
#include <string>
#include <vector>

#include "core/base/time.hpp"

namespace swiftlet {

/// What a relay does to the datagrams that pass it, in each direction.
struct RelayFaults {
  double loss = 0.0;            ///< share that is dropped
  double duplicates = 0.0;      ///< share that is sent twice
  double delay_ms = 0.0;        ///< of all
  double jitter_ms = 0.0;       ///< more, drawn for each: they overtake each other
  double truncation = 0.0;      ///< share that is cut off at a place drawn
  double bit_flips = 0.0;       ///< share in which a bit is inverted
  double garbage_hz = 0.0;      ///< datagrams of random bytes towards the client
  double outage_every_s = 0.0;  ///< 0: none
  double outage_s = 0.0;        ///< in which nothing passes

  /// "loss=0.2"; false: it is no such fault.
  bool set(const std::string& assignment);
};

/// Passes datagrams between one client and a server on the loopback, faults included. Time is an
/// argument. One thread at a time; allocates.
class FaultRelay {
 public:
  FaultRelay(std::uint16_t server_port, const RelayFaults& faults, std::uint64_t seed);
  ~FaultRelay();
  FaultRelay(const FaultRelay&) = delete;
  FaultRelay& operator=(const FaultRelay&) = delete;

  /// Where clients find it.
  [[nodiscard]] std::uint16_t port() const;
  /// Receives what has arrived and sends what is due. To be called each millisecond; the first call begins
  /// the time of outages and garbage.
  void serve(HostTime now);
  /// Datagrams of garbage so far.
  [[nodiscard]] std::uint64_t garbage_sent() const { return garbage_sent_; }

 private:
  using Bytes = std::vector<std::uint8_t>;
  struct Flying {
    HostTime due;
    std::uint64_t number = 0;  // of equal times, the first comes first
    bool to_client = false;
    Bytes bytes;
    bool operator>(const Flying& other) const {
      return due != other.due ? due > other.due : number > other.number;
    }
  };

  void take_from(int socket, bool to_client, HostTime now);
  void pass(Bytes bytes, bool to_client, HostTime now);
  void send_due(HostTime now);
  void send_garbage(HostTime now);
  [[nodiscard]] double seconds_at(HostTime now);
  void send(const Bytes& bytes, bool to_client) const;
  [[nodiscard]] bool chance(double share) { return std::bernoulli_distribution(share)(random_); }
  [[nodiscard]] std::size_t draw_below(std::size_t end) { return random_() % end; }

  RelayFaults faults_;
  std::mt19937_64 random_;
  int front_;
  int back_;
  std::optional<sockaddr_in> client_;
  std::optional<HostTime> began_at_;
  std::uint64_t number_ = 0;
  std::uint64_t garbage_sent_ = 0;
  std::priority_queue<Flying, std::vector<Flying>, std::greater<>> flying_;
};

}  // namespace swiftlet
