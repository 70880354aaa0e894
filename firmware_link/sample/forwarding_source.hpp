// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "firmware_link/sample/sample_source.hpp"

namespace swiftlet {

/// A source that changes the samples of another one, and is like it in all that is not overridden. It has no
/// again() unless it says how its changes are made then.
class ForwardingSource : public SampleSource {
 public:
  explicit ForwardingSource(std::unique_ptr<SampleSource> inner) : inner_(std::move(inner)) {}

  [[nodiscard]] Result<ReceivedSample> next() override { return inner_->next(); }
  [[nodiscard]] const BeamLayout& beams() const override { return inner_->beams(); }
  [[nodiscard]] const SensorModel& sensor() const override { return inner_->sensor(); }
  [[nodiscard]] const InputReport& report() const override {
    return report_at_end_ ? *report_at_end_ : inner_->report();
  }
  [[nodiscard]] std::optional<double> progress() const override { return inner_->progress(); }
  [[nodiscard]] bool is_live() const override { return inner_->is_live(); }
  [[nodiscard]] std::optional<LiveStatus> live_status() const override { return inner_->live_status(); }
  [[nodiscard]] std::optional<VehicleEvent> take_event() override { return inner_->take_event(); }
  void end() override {
    inner_->end();
    report_at_end_ = inner_->report();
  }
  [[nodiscard]] std::vector<StampedPose> ground_truth() const override { return inner_->ground_truth(); }
  [[nodiscard]] std::vector<MendedOdometry> mended() const override { return inner_->mended(); }

 protected:
  [[nodiscard]] SampleSource& inner() { return *inner_; }
  [[nodiscard]] const SampleSource& inner() const { return *inner_; }
  /// A remark of its own. Precondition: it has ended.
  void add_note(std::string note) { report_at_end_->notes.push_back(std::move(note)); }

 private:
  std::unique_ptr<SampleSource> inner_;
  std::optional<InputReport> report_at_end_;
};

}  // namespace swiftlet
