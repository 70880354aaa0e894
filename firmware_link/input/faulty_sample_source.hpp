// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "firmware_link/sample/sample_source.hpp"
#include "firmware_link/simulation/motion_fault.hpp"

namespace swiftlet {

/// A simulated flight whose dead reckoning breaks by its faults. The truth stays that of the flight. A fault
/// that it did not come to is a note of its report once it has ended.
class FaultySampleSource final : public SampleSource {
 public:
  /// `faults`: in the order of time.
  FaultySampleSource(std::unique_ptr<SampleSource> flight, std::vector<MotionFault> faults)
      : flight_(std::move(flight)), faults_(std::move(faults)) {}

  [[nodiscard]] Result<ReceivedSample> next() override;
  [[nodiscard]] const BeamLayout& beams() const override { return flight_->beams(); }
  [[nodiscard]] const SensorModel& sensor() const override { return flight_->sensor(); }
  [[nodiscard]] const InputReport& report() const override {
    return report_at_end_ ? *report_at_end_ : flight_->report();
  }
  [[nodiscard]] std::optional<double> progress() const override { return flight_->progress(); }
  [[nodiscard]] bool is_live() const override { return flight_->is_live(); }
  [[nodiscard]] std::optional<LiveStatus> live_status() const override { return flight_->live_status(); }
  [[nodiscard]] std::optional<VehicleEvent> take_event() override { return flight_->take_event(); }
  void end() override;
  [[nodiscard]] std::vector<StampedPose> ground_truth() const override;

 private:
  struct Delivered {
    std::size_t number = 0;  // among the flight's samples
    Duration added{};        // to its stamp
  };
  void begin(const MotionFault& fault, RangeSample& sample);
  void place(RangeSample& sample);
  void turn_to(double turned_rad, const Pose2& T_odom_body);

  std::unique_ptr<SampleSource> flight_;
  std::vector<MotionFault> faults_;
  std::size_t next_fault_ = 0;
  std::optional<DeviceTime> first_at_;
  std::optional<MotionFault> lasting_;  // what hides the flight now
  Duration added_{};                    // to all stamps
  std::size_t received_ = 0;            // of the flight's samples
  std::vector<Delivered> delivered_;
  Pose2 T_fault_odom_;       // what faults have done to the estimate
  double turned_rad_ = 0.0;  // by the fault that lasts
  Pose2 T_odom_last_;        // of the last sample, before faults
  std::optional<InputReport> report_at_end_;
};

}  // namespace swiftlet
