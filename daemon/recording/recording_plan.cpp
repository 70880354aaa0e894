// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "daemon/recording/recording_plan.hpp"

#include "daemon/recording/recording_files.hpp"
#include "firmware_link/input/recorded_vehicle.hpp"

namespace swiftlet {
namespace {

constexpr std::uint64_t kMegabyte = 1'000'000;

std::uint64_t bytes_of(int megabytes) { return static_cast<std::uint64_t>(megabytes) * kMegabyte; }

}  // namespace

Result<std::optional<RecordingPlan>> plan_recording(const InputUri& input, const RecordingWish& wish,
                                                    const RecordConfig& config, HostTime now) {
  const bool is_file = input.kind == InputUri::Kind::kFile;
  const bool is_live = !is_file && input.kind != InputUri::Kind::kSimulation;
  if (wish.refused || !(wish.asked || (config.enabled && is_live))) return std::optional<RecordingPlan>();
  if (is_file)
    return Error{ErrorCode::kInvalidInput,
                 input.path + ": is no vehicle; record one (radio://, usb://, udp://) or sim://WORLD"};
  RecordingPlan plan;
  plan.vehicle = capture_vehicle_of(input);
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
