// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/base/time.hpp"
#include "firmware_link/crtp/crtp_packet.hpp"
#include "firmware_link/session/pending_request.hpp"
#include "firmware_link/session/toc_cache.hpp"
#include "firmware_link/session/toc_download.hpp"

namespace swiftlet {

/// Requests what a vehicle is and carries: firmware, device type, decks. Reads only; needs neither log nor
/// flight, so it can run beside them. No link, no clock: the caller passes the time and the packets received.
/// One thread at a time; allocates; `cache` must outlive it.
class VehicleInventory {
 public:
  explicit VehicleInventory(TocCache& cache);

  /// The packet to send now, if any.
  [[nodiscard]] std::optional<CrtpPacket> next_request(HostTime now);
  /// A packet from the vehicle.
  void on_frame(std::span<const std::uint8_t> packet, HostTime at);

  [[nodiscard]] bool finished() const { return step_ == Step::kFinished; }
  /// Of the parameters.
  [[nodiscard]] const TocDownload& toc() const { return toc_; }

  // Once finished. Texts are empty if the vehicle does not report them: firmware of 2018 does not report its
  // type.
  [[nodiscard]] const std::string& firmware() const { return firmware_; }
  [[nodiscard]] const std::string& device_type() const { return device_type_; }
  /// nullopt: the vehicle does not report it.
  [[nodiscard]] std::optional<bool> has_multiranger() const;
  [[nodiscard]] std::optional<bool> has_flow_deck() const;

 private:
  enum class Step { kFirmware, kDeviceType, kToc, kDecks, kFinished };
  struct Deck {
    const char* param;
    std::uint16_t id = 0;
    std::optional<bool> attached;
  };

  void ask_version(Step step, VersionQuery query);
  void on_version(std::span<const std::uint8_t> packet, VersionQuery query, std::string& text);
  void leave_version();
  void on_deck(std::span<const std::uint8_t> packet);
  void plan_decks();
  void ask_next_deck();

  TocDownload toc_;
  Step step_ = Step::kFirmware;
  PendingRequest request_;
  int version_requests_ = 0;  ///< sent for the present version
  std::string firmware_;
  std::string device_type_;
  std::vector<Deck> decks_;
  std::size_t deck_ = 0;
};

}  // namespace swiftlet
