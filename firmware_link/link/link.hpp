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

enum class LinkDirection : std::uint8_t { kToVehicle, kFromVehicle };

/// One CRTP packet as it passed the link: header byte and up to 30 data bytes.
struct LinkFrame {
  HostTime at{};  ///< when the host received it (sent it, for kToVehicle)
  LinkDirection direction = LinkDirection::kFromVehicle;
  std::uint8_t size = 0;
  std::array<std::uint8_t, 31> bytes{};

  [[nodiscard]] std::span<const std::uint8_t> packet() const { return {bytes.data(), size}; }
};

/// A way to hear a vehicle: radio, USB, UDP, simulation or a recording. Hands over raw frames in the order in
/// which they passed; those sent to the vehicle are handed back too (a recording holds them, and the log
/// session learns the block layouts from them). One thread at a time.
class Link {
 public:
  Link() = default;
  virtual ~Link() = default;
  Link(const Link&) = delete;
  Link& operator=(const Link&) = delete;

  /// The next frame. Errors: kTimeout: nothing received in time, try again. kEndOfRecording: a replay or
  /// simulation is over. kDamaged: the recording is unusable from here; the message names the byte offset.
  /// A live link outlives everything: dongle pulled, vehicle switched off; it answers kTimeout until the
  /// vehicle is received again, and statistics() says what it waits for.
  [[nodiscard]] virtual Result<LinkFrame> receive(Duration timeout) = 0;
  /// Hands a packet to the vehicle. A live link sends it within the next receive(), which hands it back as
  /// sent; what it has no room for is dropped: requests are repeated anyway. A recording ignores it.
  [[nodiscard]] virtual Status send(std::span<const std::uint8_t> packet) = 0;
  [[nodiscard]] virtual LinkStatistics statistics() const { return {}; }
};

}  // namespace swiftlet
