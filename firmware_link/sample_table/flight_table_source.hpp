// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <memory>
#include <string>

#include "core/base/result.hpp"
#include "firmware_link/file/gzip_lines.hpp"
#include "firmware_link/sample/landed_odometry_freeze.hpp"
#include "firmware_link/sample/sample_assembler.hpp"
#include "firmware_link/sample/sample_source.hpp"

namespace swiftlet {

/// Whether the file is a table of log blocks, by its first line. False if it cannot be read.
[[nodiscard]] bool is_flight_table(const std::string& path);

/// Range samples from the decoded log blocks of a Crazyflie's flight, a row each, as the data set of the IROS
/// 2022 paper has them, plain or gzip:
///
///     1,host_time_s,device_ms,x_m,y_m,..
///     2,host_time_s,device_ms,qw,qx,qy,qz,front_m,back_m,left_m,right_m,..
///
/// The samples are those of the capture of that flight. A row that cannot be used ends the input, and a
/// problem names it. One thread at a time.
class FlightTableSource final : public SampleSource {
 public:
  /// Errors: as size_of_input_file.
  [[nodiscard]] static Result<std::unique_ptr<SampleSource>> open(const std::string& path,
                                                                  const SampleSourceOptions& options);

  [[nodiscard]] Result<ReceivedSample> next() override;
  [[nodiscard]] const BeamLayout& beams() const override { return beams_; }
  [[nodiscard]] const SensorModel& sensor() const override { return sensor_; }
  [[nodiscard]] const InputReport& report() const override { return report_; }

 private:
  FlightTableSource(std::string path, GzipLines lines, const SensorModel& sensor);
  /// Reads a row.
  void feed();
  void end_with(const std::string& problem);

  std::string path_;
  GzipLines lines_;
  BeamLayout beams_ = BeamLayout::multiranger();
  SensorModel sensor_;
  InputReport report_;
  LandedOdometryFreeze ground_;
  SampleAssembler assembler_;
  bool has_ended_ = false;
};

}  // namespace swiftlet
