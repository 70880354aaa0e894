// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "core/base/fixed_vector.hpp"
#include "firmware_link/link/radio_address.hpp"
#include "firmware_link/link/usb_device.hpp"

namespace swiftlet {

inline constexpr std::uint16_t kCrazyradioVendor = 0x1915;
inline constexpr std::uint16_t kCrazyradioProduct = 0x7777;
/// As bcdDevice counts: 0.40, the first that knows the requests.
inline constexpr std::uint16_t kOldestCrazyradioRelease = 0x0040;
inline constexpr std::size_t kMaxRadioPayload = 32;
/// A null packet: only fetches what the vehicle has to send.
inline constexpr std::array<std::uint8_t, 1> kRadioPollPacket{0xFF};

/// Of Crazyradio PA and 2.0 the latter: bcdDevice counts 0.40 to 0.99 for the PA (99.55 if self-built).
[[nodiscard]] constexpr bool is_crazyradio_2(const UsbIdentity& dongle) {
  const int major = dongle.release_bcd >> 8;
  return major != 0 && major != 0x99;
}
/// What a dongle can be tuned to. A Crazyradio 2.0 accepts more, and then nothing is ever acknowledged.
struct RadioRange {
  RadioRate slowest = RadioRate::k250Kbps;
  std::uint8_t last_channel = 125;
  [[nodiscard]] bool holds(const RadioAddress& address) const {
    return address.rate >= slowest && address.channel <= last_channel;
  }
};
[[nodiscard]] constexpr RadioRange radio_range(bool is_crazyradio_2) {
  return is_crazyradio_2 ? RadioRange{RadioRate::k1Mbps, 100} : RadioRange{};
}

/// The dongles that RadioAddress::dongle selects: by index, by serial number, or all of them ("*"). If none
/// has that serial number: those whose serial number may not be read.
[[nodiscard]] std::vector<UsbIdentity> dongles_named(const std::string& name,
                                                     std::vector<UsbIdentity> plugged_in);

/// The outcome of one packet.
struct RadioAnswer {
  /// kDone: the dongle has answered. kTimeout, kStall: it has not; it was recovered, continue. Others: reopen
  /// it.
  UsbOutcome outcome = UsbOutcome::kDone;
  bool acknowledged = false;                            ///< false: all tries were lost
  std::uint8_t retries = 0;                             ///< retransmissions it took, where acknowledged
  FixedVector<std::uint8_t, kMaxRadioPayload> payload;  ///< what the vehicle sent back, 0 to 32 bytes

  [[nodiscard]] bool may_go_on() const {
    return outcome == UsbOutcome::kDone || outcome == UsbOutcome::kTimeout || outcome == UsbOutcome::kStall;
  }
};

/// A Crazyradio PA or 2.0: sends one packet, fetches one. One thread at a time; must not outlive the bus.
class Crazyradio {
 public:
  /// Finds the dongle that `address` names, resets it, ends the modes that survive a reset and tunes it; of
  /// several the first with which all that succeeds. Failures, of the first: kNoDevice, kAccessDenied (also
  /// where the serial numbers may not be read), kBusy, kFault (also firmware before 0.40), kStall, kTimeout,
  /// kUnsuited (not in its range()).
  [[nodiscard]] static std::variant<Crazyradio, UsbOutcome> open(UsbBus& bus, const RadioAddress& address);

  /// One packet out, its answer in. Takes about 1 ms, 10 ms without an acknowledgement, 0.25 s without an
  /// answer of the dongle. A late answer is discarded before the next packet. Allocates nothing.
  /// Precondition: 1 to 32 bytes.
  [[nodiscard]] RadioAnswer exchange(std::span<const std::uint8_t> packet);

  [[nodiscard]] RadioRange range() const { return radio_range(is_crazyradio_2_); }
  [[nodiscard]] const std::string& serial() const { return serial_; }

  // Settings. A value that is set already is not sent again. Precondition: in its range().
  [[nodiscard]] UsbOutcome set_rate(RadioRate rate);
  [[nodiscard]] UsbOutcome set_channel(std::uint8_t channel);
  [[nodiscard]] UsbOutcome set_address(const std::array<std::uint8_t, 5>& address);
  /// Retransmissions after the first try. Precondition: 0..15.
  [[nodiscard]] UsbOutcome set_retries(std::uint8_t retries);

 private:
  Crazyradio(std::unique_ptr<UsbDevice> device, const UsbIdentity& identity)
      : device_(std::move(device)), is_crazyradio_2_(is_crazyradio_2(identity)), serial_(identity.serial) {}
  [[nodiscard]] static std::variant<Crazyradio, UsbOutcome> open(UsbBus& bus, const UsbIdentity& identity,
                                                                 const RadioAddress& address);
  [[nodiscard]] UsbOutcome initialise(const RadioAddress& address);
  [[nodiscard]] UsbOutcome leave_modes();
  [[nodiscard]] UsbOutcome request(std::uint8_t request, std::uint16_t value,
                                   std::span<const std::uint8_t> data = {});
  /// After a failed transfer: makes the endpoint usable again, if possible.
  [[nodiscard]] UsbOutcome recover(std::uint8_t endpoint, UsbOutcome failure);
  struct Drained {
    UsbOutcome outcome = UsbOutcome::kDone;
    int answers = 0;
  };
  /// Discards answers of the dongle until none has come for that long.
  [[nodiscard]] Drained drain(Duration quiet);
  [[nodiscard]] RadioAnswer exchange_once(std::span<const std::uint8_t> packet);
  [[nodiscard]] RadioAnswer decode(std::size_t size) const;

  std::unique_ptr<UsbDevice> device_;
  bool is_crazyradio_2_;
  std::string serial_;
  std::optional<RadioRate> rate_;
  std::optional<std::uint8_t> channel_;
  std::optional<std::array<std::uint8_t, 5>> address_;
  std::optional<std::uint8_t> retries_;
  bool answer_may_be_late_ = false;
  /// A whole USB packet: a shorter buffer would overflow if the dongle sent more than expected.
  std::array<std::uint8_t, 64> buffer_{};
};

}  // namespace swiftlet
