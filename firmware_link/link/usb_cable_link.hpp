// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/base/result.hpp"
#include "core/base/time.hpp"
#include "firmware_link/link/link.hpp"
#include "firmware_link/link/link_clock.hpp"
#include "firmware_link/link/link_statistics.hpp"
#include "firmware_link/link/reopen_schedule.hpp"
#include "firmware_link/link/uplink_queue.hpp"
#include "firmware_link/link/usb_device.hpp"

namespace swiftlet {

/// The vehicles on cables, in the order of their indices; among them devices with the same numbers whose
/// manufacturer may not be read.
[[nodiscard]] std::vector<UsbIdentity> vehicles_on_cables(UsbBus& bus);

/// A vehicle on its own USB cable: each transfer is a packet, nothing is lost, nothing is polled. While the
/// link has it, the vehicle does not answer by radio; the destructor releases it. Delivers requests as a
/// RadioLink does. One thread at a time; the arguments of its constructor must outlive it. Allocates only
/// while it opens the vehicle.
class UsbCableLink final : public Link {
 public:
  /// `index`: which of the vehicles on cables, from 0. The vehicle is opened by the first receive(). Where it
  /// is lost it is waited for, by its serial number.
  UsbCableLink(UsbBus& bus, LinkClock& clock, int index);
  ~UsbCableLink() override;

  /// Error: kTimeout only.
  [[nodiscard]] Result<LinkFrame> receive(Duration timeout) override;
  /// Error: kInvalidInput: not 1 to 31 bytes, or a null packet.
  [[nodiscard]] Status send(std::span<const std::uint8_t> packet) override;
  [[nodiscard]] LinkStatistics statistics() const override { return statistics_; }
  [[nodiscard]] UplinkQueue* uplink() override { return &uplink_; }

 private:
  void open(HostTime now);
  [[nodiscard]] UsbOutcome open_vehicle();
  [[nodiscard]] const UsbIdentity* choose(const std::vector<UsbIdentity>& vehicles) const;
  void lose_vehicle(UsbOutcome failure);
  void watch_silence(HostTime now);
  [[nodiscard]] std::optional<LinkFrame> send_next(HostTime now);
  [[nodiscard]] std::optional<LinkFrame> listen(Duration timeout);
  /// Whether the transfer succeeded; else recovers the endpoint if possible, or gives the vehicle up.
  [[nodiscard]] bool check(UsbTransfer transfer, std::uint8_t endpoint);

  UsbBus& bus_;
  LinkClock& clock_;
  int index_;
  std::string serial_;  ///< of the vehicle that was opened
  ReopenSchedule reopen_;
  std::unique_ptr<UsbDevice> vehicle_;
  int failures_in_a_row_ = 0;
  LinkStatistics statistics_;
  UplinkQueue uplink_;
  bool has_just_sent_ = false;  ///< the last frame was a packet of the client, sent
  HostTime received_at_;
  bool silent_ = false;
  std::array<std::uint8_t, 64> buffer_{};
};

}  // namespace swiftlet
