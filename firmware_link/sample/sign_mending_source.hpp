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
#include "firmware_link/sample/forwarding_source.hpp"

namespace swiftlet {

/// A recording whose odometry may report reverse driving as forward, mended by LostSign. Reads ahead of what
/// it delivers, so it is for sources that are not live; counters, problems and progress are those of when the
/// delivered sample was read.
class SignMendingSource final : public ForwardingSource {
 public:
  explicit SignMendingSource(std::unique_ptr<SampleSource> recording, const LostSignTuning& tuning = {})
      : ForwardingSource(std::move(recording)),
        signs_(inner().sensor(), inner().beams(), tuning),
        report_(inner().report()) {}

  [[nodiscard]] Result<ReceivedSample> next() override;
  [[nodiscard]] const InputReport& report() const override { return report_; }
  [[nodiscard]] std::optional<double> progress() const override { return progress_; }
  [[nodiscard]] std::unique_ptr<SampleSource> again(std::optional<Duration> range_age) const override {
    return inner().again(range_age);
  }
  void end() override;
  [[nodiscard]] std::vector<MendedOdometry> mended() const override {
    return mended_in_turn(inner().mended(), signs_.mended());
  }

 private:
  /// What the recording said when a sample had been read.
  struct Reading {
    InputCounters counters;
    std::size_t problems = 0;
    std::optional<double> progress;
  };

  LostSign signs_;
  std::deque<Reading> readings_;  // of the samples that signs_ holds
  std::optional<Error> outcome_;  // what ended the recording
  InputReport report_;
  std::optional<double> progress_;

  void keep_reading();
  void report_next_reading();
};

}  // namespace swiftlet
