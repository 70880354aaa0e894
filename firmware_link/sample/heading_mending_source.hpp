// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "core/sensing/heading_leaps.hpp"
#include "firmware_link/sample/sample_source.hpp"

namespace swiftlet {

/// Samples of a flying vehicle, live or not, whose heading may leap, mended by HeadingLeaps. How often it did
/// is a note of the report once it has ended. next() allocates no more than the vehicle's own.
class HeadingMendingSource final : public SampleSource {
 public:
  explicit HeadingMendingSource(std::unique_ptr<SampleSource> flight) : flight_(std::move(flight)) {}

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
  [[nodiscard]] std::unique_ptr<SampleSource> again(std::optional<Duration> range_age) const override;
  void end() override;
  [[nodiscard]] std::vector<StampedPose> ground_truth() const override { return flight_->ground_truth(); }
  [[nodiscard]] std::vector<MendedOdometry> mended() const override { return leaps_.mended(); }

 private:
  std::unique_ptr<SampleSource> flight_;
  HeadingLeaps leaps_;
  std::optional<InputReport> report_at_end_;
};

}  // namespace swiftlet
