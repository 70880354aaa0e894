// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include "core/base/result.hpp"
#include "core/base/time.hpp"
#include "daemon/config/configuration.hpp"
#include "firmware_link/capture/capture_format.hpp"
#include "firmware_link/input/input_uri.hpp"

namespace swiftlet {

/// What is recorded, and where to.
struct RecordingPlan {
  CaptureVehicle vehicle;
  /// This file, which must not be there yet, however long it becomes. Empty: files named by the time in
  /// `directory`, which is made where missing.
  std::string file;
  std::filesystem::path directory;
  HostTime began{};                   ///< names those files
  std::uint64_t max_file_bytes = 0;   ///< beyond that much one of them is continued in the next
  std::uint64_t max_total_bytes = 0;  ///< beyond that much the oldest recordings of the directory are removed
  /// A simulation waits for the disk. False for a live link, which cannot.
  bool source_can_wait = false;
};

/// The command line's options on recording, beside the configuration.
struct RecordingWish {
  bool asked = false;    ///< --record: also where it is not the custom, or is switched off
  bool refused = false;  ///< --no-record
  std::string file;      ///< of --record; empty: named by the time, in the configured directory
};

/// What a run with this input records: nothing, or where to. By custom live links are recorded, simulations
/// are not. Errors: kInvalidInput: a file is to be recorded. kNotFound: no place for recordings.
[[nodiscard]] Result<std::optional<RecordingPlan>> plan_recording(const InputUri& input,
                                                                  const RecordingWish& wish,
                                                                  const RecordConfig& config, HostTime now);

}  // namespace swiftlet
