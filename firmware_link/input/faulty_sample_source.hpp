// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "firmware_link/sample/forwarding_source.hpp"
#include "firmware_link/simulation/motion_fault.hpp"

namespace swiftlet {

/// A simulated flight whose dead reckoning breaks by its faults. The truth stays that of the flight. Its
/// report counts samples, segments, gaps and missing packets as they are behind the faults; the rest is the
/// link's, which hears all. A fault that the flight did not come to is a note there once it has ended.
class FaultySampleSource final : public ForwardingSource {
 public:
  /// `faults`: in the order of time.
  FaultySampleSource(std::unique_ptr<SampleSource> flight, std::vector<MotionFault> faults)
      : ForwardingSource(std::move(flight)), faults_(std::move(faults)) {
    update_report();
  }

  [[nodiscard]] Result<ReceivedSample> next() override;
  [[nodiscard]] const InputReport& report() const override { return report_; }
  void end() override;
  [[nodiscard]] std::vector<StampedPose> ground_truth() const override;

 private:
  struct Delivered {
    std::size_t number = 0;  // among the flight's samples
    Duration added{};        // to its stamp
  };
  Result<ReceivedSample> next_of_those_left();
  bool survives_faults(RangeSample& sample, Duration at);
  void begin(const MotionFault& fault, RangeSample& sample);
  void place(RangeSample& sample);
  void turn_to(double turned_rad, const Pose2& T_odom_body);
  void update_report();

  std::vector<MotionFault> faults_;
  std::size_t next_fault_ = 0;
  std::optional<DeviceTime> first_at_;
  std::optional<MotionFault> lasting_;  // what hides the flight now
  Duration added_{};                    // to all stamps
  std::size_t received_ = 0;            // of the flight's samples
  std::vector<Delivered> delivered_;
  Pose2 T_fault_odom_;          // what faults have done to the estimate
  double turned_rad_ = 0.0;     // by the fault that lasts
  Pose2 T_odom_last_;           // of the last sample, before faults
  std::uint64_t segments_ = 0;  // of the samples that were delivered
  std::uint64_t gaps_ = 0;      // by the faults alone, as the next
  std::uint64_t missing_ = 0;
  InputReport report_;
};

}  // namespace swiftlet
