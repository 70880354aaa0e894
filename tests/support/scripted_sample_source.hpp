// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "firmware_link/sample/sample_source.hpp"

namespace swiftlet {

/// Delivers a list of samples, then ends as the test has set.
class ScriptedSampleSource final : public SampleSource {
 public:
  explicit ScriptedSampleSource(std::vector<RangeSample> samples,
                                Error end = {ErrorCode::kEndOfRecording, "end of the script"})
      : samples_(std::move(samples)), end_(std::move(end)) {}

  [[nodiscard]] Result<ReceivedSample> next() override {
    if (next_ == samples_.size()) return end_;
    ++report_.counters.samples;
    return ReceivedSample{.sample = samples_[next_++], .arrived_at = arrived_at.value_or(MonotonicTime{})};
  }
  [[nodiscard]] const BeamLayout& beams() const override { return beams_; }
  [[nodiscard]] const SensorModel& sensor() const override { return sensor_; }
  [[nodiscard]] const InputReport& report() const override { return report_; }
  [[nodiscard]] std::optional<LiveStatus> live_status() const override { return live; }
  [[nodiscard]] std::optional<VehicleEvent> take_event() override {
    return std::exchange(event, std::nullopt);
  }
  [[nodiscard]] std::optional<double> progress() const override {
    return static_cast<double>(next_) / static_cast<double>(samples_.size());
  }

  [[nodiscard]] bool is_live() const override { return arrived_at.has_value(); }

  std::optional<MonotonicTime> arrived_at;  // of every sample; makes it live
  LiveStatus live;
  std::optional<VehicleEvent> event;

 private:
  std::vector<RangeSample> samples_;
  Error end_;
  std::size_t next_ = 0;
  BeamLayout beams_ = BeamLayout::multiranger();
  SensorModel sensor_ = SensorModel::crazyflie();
  InputReport report_;
};

/// `count` samples at 10 Hz, all of them at the origin, seeing nothing.
inline std::vector<RangeSample> resting_samples(std::uint32_t count) {
  std::vector<RangeSample> out(count);
  for (std::uint32_t i = 0; i < count; ++i) {
    out[i].sequence = i;
    out[i].stamp = HostTime(std::chrono::seconds(1'700'000'000) + i * std::chrono::milliseconds(100));
    out[i].measured_at = DeviceTime(i * std::chrono::milliseconds(100));
    out[i].starts_segment = i == 0;
    out[i].beam_count = 4;
    out[i].status.fill(RangeStatus::kInvalid);
  }
  return out;
}

/// A flight in circles around the middle of a square room with walls at +-`half_side_m`, ranges exact up to
/// 3 m, dead reckoning exact, 0.5 m/s.
inline std::vector<RangeSample> flight_in_square_room(std::uint32_t count, double half_side_m,
                                                      double radius_m) {
  std::vector<RangeSample> out = resting_samples(count);
  const BeamLayout beams = BeamLayout::multiranger();
  for (std::uint32_t i = 0; i < count; ++i) {
    const double turned_rad = 0.05 * static_cast<double>(i) / radius_m;
    const Pose2 T_odom_body(radius_m * std::cos(turned_rad), radius_m * std::sin(turned_rad),
                            turned_rad + kPi / 2.0);
    out[i].T_odom_body = T_odom_body;
    for (std::size_t b = 0; b < beams.count; ++b) {
      const double bearing = T_odom_body.yaw_rad() + beams.bearing_rad[b];
      const auto to_wall = [half_side_m](double from, double along) {
        return along == 0.0 ? 1e9 : ((along > 0.0 ? half_side_m : -half_side_m) - from) / along;
      };
      const double distance = std::min(to_wall(T_odom_body.x_m(), std::cos(bearing)),
                                       to_wall(T_odom_body.y_m(), std::sin(bearing)));
      out[i].status[b] = distance <= 3.0 ? RangeStatus::kHit : RangeStatus::kNoReturn;
      out[i].distance_m[b] = distance <= 3.0 ? static_cast<float>(distance) : 0.0F;
    }
  }
  return out;
}

}  // namespace swiftlet
