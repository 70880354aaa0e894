// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <cstddef>
#include <deque>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "core/sensing/lost_sign.hpp"
#include "firmware_link/sample/sample_source.hpp"

namespace swiftlet {

/// A recording whose odometry may report reverse driving as forward, mended by LostSign. Reads ahead of what
/// it delivers, so it is for sources that are not live; counters, problems and progress are those of when the
/// delivered sample was read.
class SignMendingSource final : public SampleSource {
 public:
  explicit SignMendingSource(std::unique_ptr<SampleSource> recording, const LostSignTuning& tuning = {})
      : recording_(std::move(recording)),
        signs_(recording_->sensor(), recording_->beams(), tuning),
        report_(recording_->report()) {}

  [[nodiscard]] Result<ReceivedSample> next() override;
  [[nodiscard]] const BeamLayout& beams() const override { return recording_->beams(); }
  [[nodiscard]] const SensorModel& sensor() const override { return recording_->sensor(); }
  [[nodiscard]] const InputReport& report() const override { return report_; }
  [[nodiscard]] std::optional<double> progress() const override { return progress_; }
  [[nodiscard]] std::optional<VehicleEvent> take_event() override { return recording_->take_event(); }
  [[nodiscard]] std::unique_ptr<SampleSource> again(std::optional<Duration> range_age) const override {
    return recording_->again(range_age);
  }
  void end() override;
  [[nodiscard]] std::vector<StampedPose> ground_truth() const override { return recording_->ground_truth(); }
  [[nodiscard]] std::vector<MendedOdometry> mended() const override {
    return mended_in_turn(recording_->mended(), signs_.mended());
  }

 private:
  /// What the recording said when a sample had been read.
  struct Reading {
    InputCounters counters;
    std::size_t problems = 0;
    std::optional<double> progress;
  };

  std::unique_ptr<SampleSource> recording_;
  LostSign signs_;
  std::deque<Reading> readings_;  // of the samples that signs_ holds
  std::optional<Error> outcome_;  // what ended the recording
  InputReport report_;
  std::optional<double> progress_;

  void keep_reading();
  void report_next_reading();
};

}  // namespace swiftlet
