// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <netinet/in.h>
#include <sys/socket.h>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>

#include "firmware_link/link/link.hpp"
#include "firmware_link/link/link_clock.hpp"
#include "firmware_link/link/uplink_queue.hpp"

namespace swiftlet {

/// A simulated vehicle on UDP: one datagram is one CRTP packet of 1 to 31 bytes, either way. While nothing is
/// received it registers every 200 ms, in the ways that are in use (`f3` registers with CrazySim, `ff` is the
/// client library's scan); then it sends a null packet whenever it has sent nothing for 100 ms, because a
/// vehicle deletes its log blocks after a second without any. Without requests it sends null packets only.
/// Its destructor says goodbye (`f4`), until which CrazySim answers no other program. While no vehicle
/// listens or the network is down, the condition is kSilent and the link keeps trying.
///
/// Null packets from the vehicle count as received and are not delivered. Datagrams of other sizes are
/// dropped. A frame is stamped with the time at which it reached the machine, however late it is read.
/// receive() and send() do not allocate.
class UdpLink final : public Link {
 public:
  /// Looks the name up (this may take seconds); IPv4 if it has both, because the vendor's simulators support
  /// nothing else. `clock` must outlive the link, and in it waiting for the socket take no
  /// longer than until something arrives. Errors: kNotFound: there is no
  /// such host. kInvalidInput: no socket to be had.
  [[nodiscard]] static Result<std::unique_ptr<UdpLink>> open(const std::string& host, std::uint16_t port,
                                                             LinkClock& clock);
  ~UdpLink() override;

  [[nodiscard]] Result<LinkFrame> receive(Duration timeout) override;
  /// Error: kInvalidInput: not 1 to 31 bytes, or a null packet.
  [[nodiscard]] Status send(std::span<const std::uint8_t> packet) override;
  /// As of the last receive().
  [[nodiscard]] LinkStatistics statistics() const override { return statistics_; }
  [[nodiscard]] UplinkQueue* uplink() override { return &uplink_; }

 private:
  struct Peer {
    sockaddr_storage address{};
    socklen_t size = 0;
  };
  static Result<Peer> find(const std::string& host, std::uint16_t port);

  UdpLink(int socket, const Peer& peer, LinkClock& clock) : socket_(socket), peer_(peer), clock_(clock) {}
  void note_silence(HostTime now);
  void note_received(HostTime now);
  void keep_alive(HostTime now);
  std::optional<LinkFrame> send_next(HostTime now);
  std::optional<LinkFrame> take_datagrams();
  void wait_until(HostTime wake_at, HostTime now) const;
  bool transmit(std::span<const std::uint8_t> packet, HostTime now);
  bool associate();

  int socket_;
  Peer peer_;
  LinkClock& clock_;
  HostTime delivered_at_{};  // stamp of the last frame: they never go back
  bool associated_ = false;  // with the peer: a route to it is known
  UplinkQueue uplink_;
  bool has_just_sent_ = false;           // the last frame was a packet of the client
  std::optional<HostTime> received_at_;  // since when it is not silent
  HostTime registers_at_{};              // while silent
  HostTime sent_at_{};
  LinkStatistics statistics_{.condition = LinkCondition::kSilent};
};

}  // namespace swiftlet
