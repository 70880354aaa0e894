// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "core/base/ids.hpp"
#include "core/base/result.hpp"
#include "core/sensing/range_sample.hpp"
#include "core/sensing/sensor_model.hpp"

namespace swiftlet {

// Range samples as text, a row each (docs/convert.md): what SampleTableSource reads back to equal samples.

/// What holds for all rows.
struct SampleTableHead {
  BeamLayout beams;
  SensorModel sensor;  ///< range limits and age as used, noise of a Crazyflie's or of wheeled dead reckoning
};

/// The lines before the first row.
[[nodiscard]] std::string sample_table_head(const SampleTableHead& head);
/// Appends the sample's row. `storey`: that of the sample before; where this one's is another, a line ahead
/// of the row says so.
void append_sample_row(std::string& text, const RangeSample& sample, StoreyId& storey);

/// The first line, by which a table is known; without its end.
inline constexpr std::string_view kSampleTableMark = "# swiftlet samples 1";
/// Of the second line, `# sensor ...`, and the third, `# bearings_rad ...`. Error: kInvalidInput: what is
/// wrong with them.
[[nodiscard]] Result<SampleTableHead> parse_sample_table_head(std::string_view sensor,
                                                              std::string_view bearings);
/// The line with the names of the columns, for so many beams; without its end.
[[nodiscard]] std::string sample_table_columns(std::size_t beam_count);
/// Of a line `# storey 1`: where what follows was flown. Nothing: it is no such line. Error: kInvalidInput:
/// there are fewer storeys.
[[nodiscard]] Result<std::optional<StoreyId>> parse_storey_line(std::string_view line);
/// Sequence, storey and beam count are the caller's. Ranges beyond the sensor's limits are classified anew.
/// Error: kInvalidInput: which column cannot be used.
[[nodiscard]] Result<RangeSample> parse_sample_row(std::string_view row, const SampleTableHead& head);

}  // namespace swiftlet
