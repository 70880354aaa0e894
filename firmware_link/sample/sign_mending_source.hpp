// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "core/sensing/lost_sign.hpp"
#include "firmware_link/sample/sample_source.hpp"

namespace swiftlet {

/// A recording whose odometry may report reverse driving as forward, mended by LostSign. Reads ahead of what
/// it delivers, so it is for sources that are not live.
class SignMendingSource final : public SampleSource {
 public:
  explicit SignMendingSource(std::unique_ptr<SampleSource> recording, const LostSignTuning& tuning = {})
      : recording_(std::move(recording)), signs_(recording_->sensor(), recording_->beams(), tuning) {}

  [[nodiscard]] Result<ReceivedSample> next() override;
  [[nodiscard]] const BeamLayout& beams() const override { return recording_->beams(); }
  [[nodiscard]] const SensorModel& sensor() const override { return recording_->sensor(); }
  [[nodiscard]] const InputReport& report() const override { return ended_ ? report_ : recording_->report(); }
  [[nodiscard]] std::optional<double> progress() const override { return recording_->progress(); }
  [[nodiscard]] std::optional<VehicleEvent> take_event() override { return recording_->take_event(); }
  [[nodiscard]] std::unique_ptr<SampleSource> again(std::optional<Duration> range_age) const override {
    return recording_->again(range_age);
  }
  void end() override;
  [[nodiscard]] std::vector<StampedPose> ground_truth() const override { return recording_->ground_truth(); }
  [[nodiscard]] std::vector<MendedPositions> mended() const override { return signs_.mended(); }

 private:
  std::unique_ptr<SampleSource> recording_;
  LostSign signs_;
  std::optional<Error> outcome_;  // what ended the recording
  bool ended_ = false;
  InputReport report_;  // once ended
};

}  // namespace swiftlet
