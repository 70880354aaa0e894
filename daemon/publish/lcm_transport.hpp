// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>

#include "core/base/result.hpp"
#include "core/base/time.hpp"

namespace swiftlet {

/// This machine only, as LCM's own default.
inline constexpr const char* kDefaultLcmUrl = "udpm://239.255.76.67:7667?ttl=0";

/// For a machine whose network has no multicast: what lets LCM's datagrams go round within it.
inline constexpr const char* kRouteOverLoopback =
    "sudo ip link set lo up multicast on && sudo ip route add 224.0.0.0/4 dev lo";

/// Bytes to and from LCM. A server of tcpq:// may be absent: it is looked for now and then, in silence, and
/// meanwhile nothing is published or received. One that takes or gives nothing for half a second in the
/// middle of a message counts as absent. One thread at a time.
class LcmTransport {
 public:
  using Listener = std::function<void(std::span<const std::uint8_t>)>;

  /// kInvalidInput when LCM cannot use `url` (udpm://, file://, tcpq:// or memq://), or there is no route to
  /// its multicast group. A server that does not answer within `patience` counts as absent.
  [[nodiscard]] static Result<std::unique_ptr<LcmTransport>> open(
      const std::string& url, Duration patience = std::chrono::milliseconds(500));
  ~LcmTransport();
  LcmTransport(const LcmTransport&) = delete;
  LcmTransport& operator=(const LcmTransport&) = delete;

  /// False, with errno, when LCM did not take the message (ENOTCONN: the server of tcpq:// is absent).
  [[nodiscard]] bool publish(const std::string& channel, std::span<const std::uint8_t> message);
  /// kOutOfSpace: a log that is written (file://) lacks some of what publish() gave it; LCM does not notice.
  [[nodiscard]] Status check_log() const;
  /// `listener` is called from within receive(), with each message on that channel.
  void listen(const std::string& channel, Listener listener);
  /// Waits for messages for so long at most. False when none came.
  bool receive(Duration timeout);
  /// A log that is read (file://) was received to its end: no further message comes.
  [[nodiscard]] bool has_ended() const;

 private:
  struct State;
  explicit LcmTransport(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

}  // namespace swiftlet
