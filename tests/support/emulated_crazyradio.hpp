// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>
#include <span>
#include <vector>

#include "core/base/time.hpp"
#include "firmware_link/link/usb_device.hpp"
#include "tests/support/emulated_receiver.hpp"

namespace swiftlet {

/// A vendor request from the host (bmRequestType 0x40).
struct VendorRequest {
  std::uint8_t request = 0;
  std::uint16_t value = 0;
  std::uint16_t index = 0;
  std::vector<std::uint8_t> data;
  bool operator==(const VendorRequest&) const = default;
};

/// What a Crazyradio PA is to receive when it is opened for radio://0/80/2M/E7E7E7E7E7, in this order.
[[nodiscard]] std::vector<VendorRequest> requests_at_opening();

/// What can go wrong with one OUT and its answer.
enum class DongleFault : std::uint8_t {
  kLateAnswer,  ///< the answer comes late_by late: a host that gave up finds it at its next read
  kNoAnswer,    ///< nothing was sent, no answer will come
  kStallOut,    ///< the OUT endpoint halts
  kStallIn,     ///< the IN endpoint halts; the answer waits behind it
  kOverflow,    ///< the answer is longer than what the host reads
};

enum class DongleModel : std::uint8_t { kPa, k2 };

/// A Crazyradio PA as USB shows it (firmware 0.53, with ACKs) or a Crazyradio 2.0 (5.4), without inline mode,
/// a vehicle's radio in range. Independent of how the host reaches it. Time is an argument. One thread
/// at a time; allocates.
class EmulatedCrazyradio {
 public:
  static constexpr std::uint16_t kVendor = 0x1915;
  static constexpr std::uint16_t kProduct = 0x7777;
  static constexpr const char* kManufacturer = "Bitcraze";
  static constexpr const char* kNameOfPa = "Crazyradio PA USB Dongle";
  static constexpr const char* kSerial = "E7C0FFEE01";
  static constexpr std::uint8_t kOut = 0x01;
  static constexpr std::uint8_t kIn = 0x81;

  Duration late_by = std::chrono::milliseconds(500);
  bool denies_access = false;                 ///< this user may not open it
  bool claimed_by_another = false;            ///< another program has its interface
  std::optional<DongleFault> standing_fault;  ///< of every exchange from now on

  /// The receiver must outlive it. Plugged in.
  explicit EmulatedCrazyradio(EmulatedReceiver& receiver, DongleModel model = DongleModel::kPa)
      : receiver_(receiver), model_(model) {}

  [[nodiscard]] std::uint16_t release_bcd() const { return model_ == DongleModel::kPa ? 0x0053 : 0x0504; }
  [[nodiscard]] const char* name() const { return model_ == DongleModel::kPa ? kNameOfPa : "Crazyradio 2.0"; }

  void unplug();
  /// Under a new bus address, with the settings of power-up.
  void plug_in();
  [[nodiscard]] bool is_plugged_in() const { return plugged_in_; }
  [[nodiscard]] std::uint8_t bus_address() const { return bus_address_; }

  /// Time passes for the dongle and the vehicle.
  void advance(Duration by);
  /// The next exchange that no earlier call has spoken for meets this.
  void fail_next(DongleFault fault) { next_faults_.push_back(fault); }

  [[nodiscard]] UsbOutcome control_out(const VendorRequest& request);
  /// kTimeout: the dongle does not take it, however long the host waits.
  [[nodiscard]] UsbOutcome bulk_out(std::span<const std::uint8_t> bytes);
  /// kTimeout: there is nothing to read at this moment.
  [[nodiscard]] UsbTransfer bulk_in(std::span<std::uint8_t> buffer);
  /// Until bulk_in() will have something to read; nullopt when nothing is coming.
  [[nodiscard]] std::optional<Duration> answer_in() const;
  [[nodiscard]] UsbOutcome clear_halt(std::uint8_t endpoint);
  /// Halts end, what waits to be read is thrown away, settings stay.
  [[nodiscard]] UsbOutcome reset();

  /// All vendor requests that were not stalled, in order.
  [[nodiscard]] const std::vector<VendorRequest>& requests() const { return requests_; }
  void forget_requests() { requests_.clear(); }
  [[nodiscard]] const AirSetting& setting() const { return settings_.air; }
  [[nodiscard]] std::uint64_t packets_sent() const { return packets_sent_; }

 private:
  struct Settings {
    AirSetting air{2, RadioRate::k2Mbps, {0xE7, 0xE7, 0xE7, 0xE7, 0xE7}};
    int retransmissions = 3;
    bool ack = true;
    bool carrier = false;
    std::uint16_t mode = 0;        ///< PA: 0 sends packets
    bool is_sniffing = false;      ///< 2.0
    std::uint8_t packet_loss = 0;  ///< 2.0, simulated: per cent
    [[nodiscard]] bool sends() const { return mode == 0 && !is_sniffing && packet_loss < 100; }
  };
  struct Answer {
    std::vector<std::uint8_t> bytes;
    Duration ready_at{};
    bool too_long = false;
  };

  [[nodiscard]] bool apply(const VendorRequest& request);
  [[nodiscard]] bool apply_of_model(const VendorRequest& request);
  [[nodiscard]] bool reaches_the_air() const;
  [[nodiscard]] std::optional<DongleFault> take_fault();

  EmulatedReceiver& receiver_;
  DongleModel model_;
  Settings settings_;
  Duration now_{};
  bool plugged_in_ = true;
  std::uint8_t bus_address_ = 2;
  bool out_halted_ = false;
  bool in_halted_ = false;
  std::deque<Answer> answers_;
  std::deque<DongleFault> next_faults_;
  std::vector<VendorRequest> requests_;
  std::uint64_t packets_sent_ = 0;
};

}  // namespace swiftlet
