// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "core/base/result.hpp"
#include "firmware_link/file/gzip_lines.hpp"
#include "firmware_link/sample/sample_source.hpp"
#include "firmware_link/sample_table/sample_table.hpp"

namespace swiftlet {

/// By name (.csv, .csv.gz) or first line. False if it cannot be read.
[[nodiscard]] bool is_taken_for_sample_table(const std::string& path);

/// Range samples from a table (sample_table.hpp), plain or gzip. The age of the ranges is applied in it
/// already; limits of the options count where they are narrower than the table's. A leap of the dead
/// reckoning begins a segment. A row that cannot be used
/// ends the input, and a problem names it. One thread at a time.
class SampleTableSource final : public SampleSource {
 public:
  /// Errors: as size_of_input_file; kInvalidInput: it is no table of samples.
  [[nodiscard]] static Result<std::unique_ptr<SampleSource>> open(const std::string& path,
                                                                  const SampleSourceOptions& options);

  [[nodiscard]] Result<ReceivedSample> next() override;
  [[nodiscard]] const BeamLayout& beams() const override { return head_.beams; }
  [[nodiscard]] const SensorModel& sensor() const override { return head_.sensor; }
  [[nodiscard]] const InputReport& report() const override { return report_; }

 private:
  SampleTableSource(std::string path, GzipLines lines, const SampleTableHead& head);
  Error end_with(const std::string& problem);
  Error end_at_line(const std::string& problem);
  Result<std::string_view> next_row();
  void count(const RangeSample& sample);
  [[nodiscard]] bool leaps(const RangeSample& sample) const;

  std::string path_;
  GzipLines lines_;
  SampleTableHead head_;
  InputReport report_;
  std::optional<RangeSample> last_;
  StoreyId storey_{};  ///< of the rows that follow
  bool has_ended_ = false;
};

}  // namespace swiftlet
