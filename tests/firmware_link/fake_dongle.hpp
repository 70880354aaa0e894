// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "firmware_link/link/usb_device.hpp"
#include "tests/firmware_link/frames.hpp"
#include "tests/firmware_link/manual_link_clock.hpp"

namespace swiftlet {

/// The vehicle's radio, by the protocol's table and not by the host's code.
struct FakeRadioVehicle {
  bool knows_safelink = true;
  bool has_safelink = false;
  int up = 1;
  int down = 1;
  std::deque<Bytes> waiting;    ///< to be sent down
  Bytes last{0xF3};             ///< sent down
  std::vector<Bytes> accepted;  ///< received, null packets left out

  /// The acknowledgement's payload.
  Bytes on_frame(const Bytes& packet) {
    if (knows_safelink && packet.size() == 3 && (packet[0] & 0xF3) == 0xF3 && packet[1] == 5) {
      has_safelink = packet[2] != 0;
      up = down = 1;
      return packet;
    }
    if (!has_safelink || ((packet[0] >> 3) & 1) != up) {
      if ((packet[0] & 0xF3) != 0xF3) accepted.push_back(packet);
      up = 1 - up;
    }
    if (has_safelink && ((packet[0] >> 2) & 1) == down) return last;
    down = 1 - down;
    const bool is_idle = waiting.empty();
    last = is_idle ? Bytes{0xF3} : waiting.front();
    if (!is_idle) waiting.pop_front();
    if (has_safelink || is_idle) last[0] = static_cast<std::uint8_t>((last[0] & 0xF3) | (down << 2));
    return last;
  }
};

/// What becomes of a packet, in the order in which they are sent.
enum class Fate {
  kDelivered,
  kPacketLost,
  kAcknowledgementLost,
  kAnsweredLate,  ///< after the host's time-out
  kNeverAnswered,
  kOutStalls,
  kInStalls,
  kOverflows,
  kFails,
};

/// A Crazyradio with a vehicle behind it, and the bus in which it is plugged or not. Takes simulated time.
class FakeDongle final : public UsbBus {
 public:
  struct Request {
    std::uint8_t number = 0;
    std::uint16_t value = 0;
    Bytes data;
    bool operator==(const Request&) const = default;
  };
  struct Packet {
    HostTime at{};
    Bytes bytes;
  };

  explicit FakeDongle(ManualLinkClock& link_clock) : clock(link_clock) {
    UsbIdentity identity;
    identity.vendor = 0x1915;
    identity.product = 0x7777;
    identity.release_bcd = 0x0053;
    identity.serial = "A1B2C3D4E5";
    plugged_in.push_back(identity);
  }

  ManualLinkClock& clock;
  std::vector<UsbIdentity> plugged_in;
  std::vector<UsbOutcome> opening;  ///< how opening the n-th of them ends; kDone beyond
  bool has_news = false;            ///< what has_changed() returns, once
  UsbOutcome reset_outcome = UsbOutcome::kDone;
  UsbOutcome request_outcome = UsbOutcome::kDone;
  std::optional<std::uint8_t> faulty;  ///< address: these two are of this one alone
  FakeRadioVehicle vehicle;
  std::function<bool()> is_in_range = [] { return true; };
  std::deque<Fate> fates;                  ///< of the next packets; delivered beyond
  std::optional<std::uint8_t> raw_status;  ///< instead of the usual 0x01
  Duration exchange_time = std::chrono::milliseconds(1);
  int lateness = 1;           ///< of late answers: reads that time out before
  std::deque<Bytes> answers;  ///< wait in the dongle to be read
  std::vector<Request> requests;
  std::vector<Packet> packets;
  std::vector<std::uint8_t> cleared;  ///< endpoints
  std::vector<std::size_t> opened;    ///< indices
  int resets = 0;
  int lists = 0;
  int open_devices = 0;

  std::vector<UsbIdentity> list(std::uint16_t vendor, std::uint16_t product) override {
    ++lists;
    std::vector<UsbIdentity> found = plugged_in;
    std::erase_if(found, [&](const UsbIdentity& id) { return id.vendor != vendor || id.product != product; });
    return found;
  }
  std::variant<std::unique_ptr<UsbDevice>, UsbOutcome> open(const UsbIdentity& identity,
                                                            int /*interface*/) override {
    const auto found = std::ranges::find(plugged_in, identity.address, &UsbIdentity::address);
    if (found == plugged_in.end()) return UsbOutcome::kNoDevice;
    const auto index = static_cast<std::size_t>(found - plugged_in.begin());
    if (index < opening.size() && opening[index] != UsbOutcome::kDone) return opening[index];
    opened.push_back(index);
    return std::make_unique<Device>(*this, identity.address);
  }
  bool has_changed() override { return std::exchange(has_news, false); }

 private:
  class Device final : public UsbDevice {
   public:
    Device(FakeDongle& dongle, std::uint8_t address) : dongle_(dongle), address_(address) {
      ++dongle_.open_devices;
    }
    ~Device() override { --dongle_.open_devices; }
    UsbTransfer control_out(std::uint8_t request, std::uint16_t value, std::uint16_t /*index*/,
                            std::span<const std::uint8_t> data, Duration /*timeout*/) override {
      dongle_.requests.push_back({request, value, Bytes(data.begin(), data.end())});
      return {outcome(dongle_.request_outcome), data.size()};
    }
    UsbTransfer bulk_out(std::uint8_t /*endpoint*/, std::span<const std::uint8_t> bytes,
                         Duration /*timeout*/) override {
      if (!is_plugged_in()) return {UsbOutcome::kNoDevice, 0};
      return dongle_.take(Bytes(bytes.begin(), bytes.end()));
    }
    UsbTransfer bulk_in(std::uint8_t /*endpoint*/, std::span<std::uint8_t> buffer,
                        Duration timeout) override {
      if (!is_plugged_in()) return {UsbOutcome::kNoDevice, 0};
      return dongle_.give(buffer, timeout);
    }
    UsbOutcome clear_halt(std::uint8_t endpoint) override {
      dongle_.cleared.push_back(endpoint);
      return UsbOutcome::kDone;
    }
    UsbOutcome reset() override {
      ++dongle_.resets;
      return outcome(dongle_.reset_outcome);
    }

   private:
    [[nodiscard]] UsbOutcome outcome(UsbOutcome set) const {
      return dongle_.faulty.value_or(address_) == address_ ? set : UsbOutcome::kDone;
    }
    [[nodiscard]] bool is_plugged_in() const {
      return std::ranges::count(dongle_.plugged_in, address_, &UsbIdentity::address) > 0;
    }
    FakeDongle& dongle_;
    std::uint8_t address_;
  };

  UsbTransfer take(const Bytes& bytes) {
    fate_ = Fate::kDelivered;
    if (!fates.empty()) {
      fate_ = fates.front();
      fates.pop_front();
    }
    if (fate_ == Fate::kOutStalls) return {UsbOutcome::kStall, 0};
    packets.push_back({clock.now(), bytes});
    clock.sleep_for(exchange_time);
    const bool is_received = is_in_range() && fate_ != Fate::kPacketLost;
    Bytes answer{0x00};
    if (is_received) {
      const Bytes payload = vehicle.on_frame(bytes);
      if (fate_ != Fate::kAcknowledgementLost) {
        answer = payload;
        answer.insert(answer.begin(), raw_status.value_or(0x01));
      }
    }
    if (fate_ == Fate::kAnsweredLate) reads_in_vain_ = lateness;
    answers.push_back(answer);
    if (fate_ == Fate::kNeverAnswered) answers.clear();
    return {UsbOutcome::kDone, bytes.size()};
  }

  UsbTransfer give(std::span<std::uint8_t> buffer, Duration timeout) {
    const Fate fate = std::exchange(fate_, Fate::kDelivered);
    if (fate == Fate::kInStalls) return {UsbOutcome::kStall, 0};
    if (fate == Fate::kOverflows) return {UsbOutcome::kOverflow, 0};
    if (fate == Fate::kFails) return {UsbOutcome::kFault, 0};
    if (answers.empty() || reads_in_vain_ > 0) {
      clock.sleep_for(timeout);
      reads_in_vain_ = std::max(0, reads_in_vain_ - 1);
      return {UsbOutcome::kTimeout, 0};
    }
    const Bytes answer = answers.front();
    answers.pop_front();
    if (answer.size() > buffer.size()) return {UsbOutcome::kOverflow, buffer.size()};
    std::ranges::copy(answer, buffer.begin());
    return {UsbOutcome::kDone, answer.size()};
  }

  Fate fate_ = Fate::kDelivered;
  int reads_in_vain_ = 0;
};

}  // namespace swiftlet
