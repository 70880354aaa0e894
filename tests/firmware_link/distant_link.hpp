// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <random>
#include <span>
#include <string>

#include "firmware_link/link/link.hpp"
#include "firmware_link/link/link_clock.hpp"
#include "tests/firmware_link/frames.hpp"
#include "tests/firmware_link/scripted_vehicle.hpp"

namespace swiftlet {

/// A link to a scripted vehicle in simulated time whose packets take their time and get lost, both ways. A
/// packet takes 1 ms to be sent; running blocks send every 100 ms.
class DistantLink final : public Link {
 public:
  ScriptedVehicle vehicle;
  std::int64_t one_way_ms = 1;
  double loss_share = 0.0;
  std::int64_t now_ms = 0;

  /// As many variables as the firmware has.
  DistantLink() {
    vehicle.variables = ScriptedVehicle::modern_variables();
    while (vehicle.variables.size() < 395)
      vehicle.variables.push_back({"other", std::to_string(vehicle.variables.size()), LogType::kFloat});
  }

  Status send(std::span<const std::uint8_t> packet) override {
    const Bytes bytes(packet.begin(), packet.end());
    to_deliver_.push_back(sent(bytes, host_ms(now_ms)));
    ++now_ms;
    if (!is_lost()) to_vehicle_.push_back({now_ms + one_way_ms, bytes});
    return {};
  }
  Result<LinkFrame> receive(Duration timeout) override {
    const std::int64_t deadline_ms = now_ms + timeout / std::chrono::milliseconds(1);
    for (; to_deliver_.empty(); ++now_ms) {
      if (now_ms >= deadline_ms) return Error{ErrorCode::kTimeout, "no packet"};
      pass_a_millisecond();
    }
    const LinkFrame frame = to_deliver_.front();
    to_deliver_.pop_front();
    return frame;
  }

 private:
  struct Flying {
    std::int64_t due_ms;
    Bytes bytes;
  };

  bool is_lost() { return std::bernoulli_distribution(loss_share)(random_); }
  void answer(const Bytes& packet) {
    if (is_lost()) return;
    to_host_.push_back({now_ms + one_way_ms, packet});
  }
  void pass_a_millisecond() {
    for (; !to_vehicle_.empty() && to_vehicle_.front().due_ms <= now_ms; to_vehicle_.pop_front())
      if (const std::optional<Bytes> reply = vehicle.answer(to_vehicle_.front().bytes)) answer(*reply);
    if (now_ms % 100 == 0 && now_ms != data_at_ms_) {
      data_at_ms_ = now_ms;
      for (const Bytes& packet : vehicle.data(static_cast<std::uint32_t>(now_ms))) answer(packet);
    }
    for (; !to_host_.empty() && to_host_.front().due_ms <= now_ms; to_host_.pop_front())
      to_deliver_.push_back(received(to_host_.front().bytes, host_ms(now_ms)));
  }

  std::mt19937 random_{1};
  std::int64_t data_at_ms_ = -1;
  std::deque<Flying> to_vehicle_;
  std::deque<Flying> to_host_;
  std::deque<LinkFrame> to_deliver_;
};

/// Its time; it must outlive the clock.
class DistantClock final : public LinkClock {
 public:
  explicit DistantClock(const DistantLink& link) : link_(link) {}
  HostTime now() override { return host_ms(link_.now_ms); }
  void sleep_for(Duration /*duration*/) override {}

 private:
  const DistantLink& link_;
};

}  // namespace swiftlet
