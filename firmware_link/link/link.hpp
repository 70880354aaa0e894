// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "core/base/result.hpp"
#include "core/base/time.hpp"
#include "firmware_link/link/link_statistics.hpp"

namespace swiftlet {

class UplinkQueue;

enum class LinkDirection : std::uint8_t { kToVehicle, kFromVehicle };

/// One CRTP packet of a link: header byte and up to 30 data bytes.
struct LinkFrame {
  HostTime at{};  ///< when the host received it (sent it, for kToVehicle)
  LinkDirection direction = LinkDirection::kFromVehicle;
  std::uint8_t size = 0;
  bool is_ours = true;  ///< false: a request of another program that shares the link, or an answer to one
  std::array<std::uint8_t, 31> bytes{};

  [[nodiscard]] std::span<const std::uint8_t> packet() const { return {bytes.data(), size}; }
};

/// A connection to a vehicle: radio, USB, UDP, simulation or a recording. Delivers raw frames in the order in
/// which they passed, including those sent to the vehicle (a recording holds them, and the log session learns
/// the block layouts from them). One thread at a time.
class Link {
 public:
  Link() = default;
  virtual ~Link() = default;
  Link(const Link&) = delete;
  Link& operator=(const Link&) = delete;

  /// The next frame. Errors: kTimeout: nothing received in time, try again. kEndOfRecording: a replay or
  /// simulation is over. kDamaged: the recording is unusable from here; the message names the byte offset. A
  /// live link survives a pulled dongle and a vehicle that is switched off: it returns kTimeout until the
  /// vehicle is received again, and statistics() reports what it waits for.
  [[nodiscard]] virtual Result<LinkFrame> receive(Duration timeout) = 0;
  /// Sends a packet to the vehicle. A live link sends it within the next receive(), which delivers it as
  /// sent; a packet without room is dropped: requests are repeated anyway. A recording ignores it.
  [[nodiscard]] virtual Status send(std::span<const std::uint8_t> packet) = 0;
  [[nodiscard]] virtual LinkStatistics statistics() const { return {}; }
  /// What it has to send, which a client may share; nullptr: it is no live link.
  [[nodiscard]] virtual UplinkQueue* uplink() { return nullptr; }
};

}  // namespace swiftlet
