// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <chrono>
#include <cstdint>
#include <optional>

#include "core/base/time.hpp"
#include "firmware_link/crtp/byte_order.hpp"
#include "firmware_link/crtp/crtp_packet.hpp"
#include "firmware_link/link/link.hpp"
#include "firmware_link/session/device_clock.hpp"

namespace swiftlet {

/// Stamps that hold the seconds of their minute alone, as the vendor's client wrote them from 2022 to May
/// 2024: continues them, over longer gaps by the clock in the log data. Times count from the first stamp's
/// minute: the date is unknown. Of one vehicle's frames, in order; one thread at a time; allocates nothing.
class MinuteStamps {
 public:
  /// Whether a stamp may be of that kind.
  static bool may_be(HostTime stamp) { return stamp < HostTime(kMinute); }

  [[nodiscard]] HostTime unwrap(const LinkFrame& frame) {
    const bool is_data = frame.direction == LinkDirection::kFromVehicle &&
                         is_on(frame.packet(), kLogDataTopic) && frame.packet().size() >= kLogDataPrefix;
    const std::optional<std::uint32_t> counter_ms =
        is_data ? std::optional(static_cast<std::uint32_t>(load_little_endian(frame.packet(), 2, 3)))
                : std::nullopt;
    const HostTime about = expected(counter_ms).value_or(frame.at);
    const HostTime at =
        frame.at + kMinute * std::chrono::round<std::chrono::minutes>(about - frame.at).count();
    last_ = at;
    if (counter_ms) last_data_ = {*counter_ms, at};
    return at;
  }

 private:
  static constexpr Duration kMinute = std::chrono::minutes(1);
  // A stamp is at most this much older than that of the frame before; and less than a minute newer.
  static constexpr Duration kMaxBack = std::chrono::seconds(5);

  struct Data {
    std::uint32_t counter_ms = 0;
    HostTime at{};
  };
  [[nodiscard]] std::optional<HostTime> expected(std::optional<std::uint32_t> counter_ms) const {
    if (!last_) return std::nullopt;
    if (counter_ms && last_data_) {
      const std::int64_t step_ms =
          DeviceClockUnwrapper::shortest_step_ms(std::int64_t{*counter_ms} - last_data_->counter_ms);
      if (step_ms > 0) return last_data_->at + std::chrono::milliseconds(step_ms);  // else it has rebooted
    }
    return *last_ + kMinute / 2 - kMaxBack;
  }

  std::optional<HostTime> last_;
  std::optional<Data> last_data_;
};

}  // namespace swiftlet
