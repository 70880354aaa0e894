// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "daemon/recording/recording_plan.hpp"

#include "daemon/recording/recording_files.hpp"

namespace swiftlet {
namespace {

constexpr std::uint64_t kMegabyte = 1'000'000;

std::uint64_t bytes_of(int megabytes) { return static_cast<std::uint64_t>(megabytes) * kMegabyte; }

}  // namespace

Result<std::optional<RecordingPlan>> plan_recording(const InputUri& input, const RecordingWish& wish,
                                                    const RecordConfig& config, HostTime now) {
  const bool is_live = input.is(InputNature::kVehicle);
  if (wish.refused || !(wish.asked || (config.enabled && is_live))) return std::optional<RecordingPlan>();
  if (const auto* file = input.as<InputFile>())
    return Error{ErrorCode::kInvalidInput,
                 file->path + ": is no vehicle; record " +
                     input_forms({InputNature::kVehicle, InputNature::kSimulation})};
  RecordingPlan plan;
  plan.vehicle = input.kind->recorded_vehicle(input.address);
  plan.file = wish.file;
  plan.began = now;
  plan.max_file_bytes = bytes_of(config.max_file_mb);
  plan.max_total_bytes = bytes_of(config.max_total_mb);
  plan.source_can_wait = !is_live;
  if (!plan.file.empty()) return std::optional(plan);
  plan.directory = config.directory;
  if (plan.directory.empty()) {
    const Result<std::filesystem::path> usual = default_recordings_directory();
    if (!usual) return usual.error();
    plan.directory = *usual;
  }
  return std::optional(plan);
}

}  // namespace swiftlet
