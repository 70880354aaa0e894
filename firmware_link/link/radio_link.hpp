// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "core/base/fixed_vector.hpp"
#include "core/base/result.hpp"
#include "core/base/time.hpp"
#include "firmware_link/crtp/crtp_packet.hpp"
#include "firmware_link/link/crazyradio.hpp"
#include "firmware_link/link/link.hpp"
#include "firmware_link/link/link_clock.hpp"
#include "firmware_link/link/link_statistics.hpp"
#include "firmware_link/link/radio_address.hpp"
#include "firmware_link/link/reopen_schedule.hpp"
#include "firmware_link/link/safelink.hpp"
#include "firmware_link/link/uplink_queue.hpp"
#include "firmware_link/link/usb_device.hpp"

namespace swiftlet {

/// A vehicle by radio. The vehicle sends only in acknowledgements, so receive() polls: without pause while
/// there is something to receive or to send, else every 5 to 10 ms, every 50 ms while the vehicle is silent.
///
/// Delivers each request once, with the time and the bytes of its first transmission and before its answer,
/// whether acknowledged or not; and each packet from the vehicle once, without null packets, link bits as
/// received. Switches the vehicle's safelink on or off, because it keeps what another program asked for. With
/// it, an unacknowledged packet is sent again until it is acknowledged. Without, it is not: the vehicle may
/// have executed it and only the acknowledgement is lost; the sender repeats a request that is not answered.
/// Requests that wait when the vehicle falls silent are dropped. A client gets back what is not acknowledged
/// then, or when the dongle is lost; sent again, it is a frame of its own in what is delivered.
///
/// One thread at a time; the arguments of its constructor must outlive it. Allocates only while it opens the
/// dongle.
class RadioLink final : public Link {
 public:
  /// The dongle is opened by the first receive(). Where it is lost it is waited for, by its serial number; of
  /// any ("*") another one will do.
  RadioLink(UsbBus& bus, LinkClock& clock, RadioAddress address);

  /// Error: kTimeout only. May take 0.3 s longer than `timeout` where the dongle does not answer.
  [[nodiscard]] Result<LinkFrame> receive(Duration timeout) override;
  /// Error: kInvalidInput: not 1 to 31 bytes, or a null packet (those switch the vehicle's radio, also off).
  [[nodiscard]] Status send(std::span<const std::uint8_t> packet) override;
  [[nodiscard]] LinkStatistics statistics() const override { return statistics_; }
  [[nodiscard]] UplinkQueue* uplink() override { return &uplink_; }

 private:
  enum class Mode { kPlain, kAsking, kSafelink };
  enum class Sent { kPoll, kAsk, kRequest };

  void open(HostTime now);
  void lose_dongle(UsbOutcome failure);
  [[nodiscard]] Duration pause() const;
  [[nodiscard]] bool is_repeating_for_client() const;
  void exchange();
  void fall_silent();
  void negotiate_safelink();
  void give_up_unacknowledged();
  [[nodiscard]] CrtpPacket next_packet(HostTime now);
  void hand_back(const LinkFrame& frame);
  void on_frame(const RadioAnswer& answer, HostTime now);
  void on_while_asking(std::span<const std::uint8_t> payload, HostTime now);
  void on_by_safelink(std::span<const std::uint8_t> payload, HostTime now);
  void on_content(std::span<const std::uint8_t> payload, HostTime now);

  UsbBus& bus_;
  LinkClock& clock_;
  RadioAddress address_;
  ReopenSchedule reopen_;
  std::optional<Crazyradio> radio_;
  int failures_in_a_row_ = 0;
  UsbOutcome last_outcome_ = UsbOutcome::kDone;  ///< of an exchange
  LinkStatistics statistics_;

  UplinkQueue uplink_;
  bool client_waits_ = false;             ///< a client that shares the link has a packet to send
  bool sent_is_ours_ = true;              ///< the last kRequest
  FixedVector<LinkFrame, 2> to_deliver_;  ///< one exchange yields a request and its acknowledgement's payload
  HostTime acted_at_ = HostTime::min();   ///< the last exchange or attempt to open
  HostTime received_at_;                  ///< any acknowledgement
  HostTime active_at_ = HostTime::min();  ///< content, either way
  bool silent_ = false;
  bool was_acknowledged_ = false;  ///< the last exchange
  bool has_more_ = false;          ///< the last exchange fetched content: there may be more

  Mode mode_ = Mode::kAsking;
  Sent sent_ = Sent::kPoll;  ///< last
  int unanswered_asks_ = 0;  ///< safelink requests acknowledged with something else
  HostTime asked_at_ = HostTime::min();
  Safelink safelink_;
  std::optional<CrtpPacket> unacknowledged_;  ///< by safelink: to be sent again, unchanged
  std::optional<CrtpPacket> last_received_;   ///< content
  int repeats_ = 0;                           ///< since repeats_since_
  HostTime repeats_since_ = HostTime::min();
};

}  // namespace swiftlet
