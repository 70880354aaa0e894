// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/base/result.hpp"
#include "firmware_link/laser_log/carmen_log.hpp"
#include "firmware_link/sample/sample_assembler.hpp"
#include "firmware_link/sample/sample_source.hpp"

namespace swiftlet {

/// Range samples from a CARMEN laser log. Dead reckoning comes from the ODOM lines, taken 0.1 s before the
/// scan, when their stamps can be trusted (they advance and span the scans) and there are half as many, or
/// there is nothing else (RAWLASER1), else from the pose in each scan's line; report().notes names the
/// choice. Stamps are the ipc_timestamps as logged; where a scan and its pose share one, an age of the ranges
/// is applied in regular times (line_times.hpp). Such scans come in the order of the file where their stamps
/// step back and their poses lie on a shorter path so: the samples' stamps step back, too. One thread at a
/// time.
class CarmenSampleSource final : public SampleSource {
 public:
  /// Errors: as read_carmen_log. Precondition: options.beam_count, if given, is 2..kMaxBeams.
  [[nodiscard]] static Result<std::unique_ptr<SampleSource>> open(const std::string& path,
                                                                  const SampleSourceOptions& options);

  [[nodiscard]] Result<ReceivedSample> next() override;
  [[nodiscard]] const BeamLayout& beams() const override { return log_->beams; }
  [[nodiscard]] const SensorModel& sensor() const override { return sensor_; }
  [[nodiscard]] const InputReport& report() const override { return report_; }
  [[nodiscard]] std::optional<double> progress() const override;
  [[nodiscard]] std::unique_ptr<SampleSource> again(std::optional<Duration> range_age) const override;

 private:
  CarmenSampleSource(std::shared_ptr<const CarmenLog> log, const SampleSourceOptions& options);
  /// False at the end of the log.
  bool feed();
  void feed_odometry(const CarmenOdometry& odometry);
  void feed_scan();
  void add_pose(const CarmenOdometry& odometry, Reading& reading);
  void tell_of_stamps();
  void finish_report();

  std::shared_ptr<const CarmenLog> log_;
  SampleSourceOptions options_;
  bool uses_odometry_lines_;
  std::vector<std::size_t> scan_order_;  // in which they were measured
  std::vector<DeviceTime> scan_times_;   // of scans that carry their poses, in that order
  SensorModel sensor_;
  InputReport report_;
  SampleAssembler assembler_;
  std::size_t next_odometry_ = 0;
  std::size_t next_scan_ = 0;
  DeviceTime last_scan_at_{};
  std::optional<CarmenOdometry> last_odometry_;
  bool is_finished_ = false;
};

}  // namespace swiftlet
