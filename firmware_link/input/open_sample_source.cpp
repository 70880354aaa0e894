// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "firmware_link/input/open_sample_source.hpp"

#include <chrono>
#include <cmath>
#include <cstddef>
#include <utility>

#include "firmware_link/capture/replay_link.hpp"
#include "firmware_link/file/input_file.hpp"
#include "firmware_link/input/input_uri.hpp"
#include "firmware_link/input/link_sample_source.hpp"
#include "firmware_link/input/live_link.hpp"
#include "firmware_link/laser_log/carmen_sample_source.hpp"
#include "firmware_link/simulation/link.hpp"

namespace swiftlet {
namespace {

constexpr const char* kBeamsIgnored = "the number of beams is the sensor's own here; --beams is ignored";

Status check_options(const SampleSourceOptions& options) {
  if (options.beam_count && (*options.beam_count < 2 || *options.beam_count > static_cast<int>(kMaxBeams)))
    return Error{ErrorCode::kInvalidInput, "--beams " + std::to_string(*options.beam_count) +
                                               ": must be from 2 to " + std::to_string(kMaxBeams)};
  if (options.range_age &&
      (*options.range_age < Duration::zero() || *options.range_age > std::chrono::seconds(1)))
    return Error{ErrorCode::kInvalidInput,
                 "range age " + std::to_string(to_seconds(*options.range_age)) + " s: must be from 0 to 1 s"};
  if (options.max_range_m && !(*options.max_range_m > 0.0 && std::isfinite(*options.max_range_m)))
    return Error{ErrorCode::kInvalidInput,
                 "maximum range " + std::to_string(*options.max_range_m) + " m: must be positive"};
  return {};
}

/// One limit given, the other the sensor's own: there must be ranges between them.
Status check_limits(const SampleSourceOptions& options, const SensorModel& usual) {
  const double min_m = options.min_range_m.value_or(usual.min_range_m);
  const double max_m = options.max_range_m.value_or(usual.max_range_m);
  if (min_m < max_m) return {};
  return Error{ErrorCode::kInvalidInput, "minimum range " + std::to_string(min_m) +
                                             " m: must be less than the maximum, here " +
                                             std::to_string(max_m) + " m"};
}

/// What all links have in common.
Result<LinkInput> link_input(const std::string& name, const SampleSourceOptions& options) {
  LinkInput input;
  input.name = name;
  input.sensor = SensorModel::crazyflie();
  const Status limits = check_limits(options, input.sensor);
  if (!limits) return limits.error();
  if (options.range_age) input.sensor.range_age = *options.range_age;
  if (options.max_range_m) input.sensor.max_range_m = *options.max_range_m;
  if (options.min_range_m) input.sensor.min_range_m = *options.min_range_m;
  if (options.beam_count) input.notes.emplace_back(kBeamsIgnored);
  return input;
}

Result<std::unique_ptr<SampleSource>> open_capture(const std::string& path,
                                                   const SampleSourceOptions& options) {
  Result<std::unique_ptr<ReplayLink>> link = ReplayLink::open(path);
  if (!link) return link.error();
  Result<LinkInput> common = link_input(path, options);
  if (!common) return common.error();
  LinkInput input = std::move(common).value();
  for (const std::string& note : (*link)->notes()) input.notes.push_back(note);
  input.progress = [replay = link->get()]() { return std::optional<double>(replay->progress()); };
  input.link = std::move(link).value();
  Result<BlockDescription> description = read_block_description(path + ".toml");
  if (description) {
    input.description = std::move(description).value();
  } else if (description.error().code != ErrorCode::kNotFound) {
    return description.error();
  }
  auto source = std::make_unique<LinkSampleSource>(std::move(input));
  const Status found = source->find_first_sample();
  if (!found) return found.error();
  return std::unique_ptr<SampleSource>(std::move(source));
}

Result<std::unique_ptr<SampleSource>> open_file(const std::string& path, const SampleSourceOptions& options) {
  const Result<std::uint64_t> size = size_of_input_file(path);
  if (!size) return size.error();
  if (begins_like_capture(path) || path.ends_with(".pcap")) return open_capture(path, options);
  const Status limits = check_limits(options, SensorModel::carmen_laser());
  if (!limits) return limits.error();
  return CarmenSampleSource::open(path, options);
}

/// Whether the vehicle is there shows in time: a live link waits for it.
Result<std::unique_ptr<SampleSource>> open_live(const std::string& uri, const InputUri& parsed,
                                                const SampleSourceOptions& options) {
  Result<LinkInput> common = link_input(uri, options);
  if (!common) return common.error();
  LinkInput input = std::move(common).value();
  input.recording = options.recording;
  input.starts_logging = true;
  input.cache_directory = TocCache::default_directory();
  Result<LiveLink> live = open_live_link(parsed);
  if (!live) return live.error();
  input.clock = live->clock;
  input.usb_bus = live->usb_bus;
  input.link = std::move(live->link);
  return std::unique_ptr<SampleSource>(std::make_unique<LinkSampleSource>(std::move(input)));
}

Result<std::unique_ptr<SampleSource>> open_simulation(const std::string& uri, const InputUri& parsed,
                                                      const SampleSourceOptions& options) {
  Result<std::unique_ptr<SimulatedLink>> link = SimulatedLink::open(parsed.world, parsed.seed, parsed.laps);
  if (!link) return link.error();
  Result<LinkInput> common = link_input(uri, options);
  if (!common) return common.error();
  LinkInput input = std::move(common).value();
  input.recording = options.recording;
  input.starts_logging = true;
  input.progress = [simulated = link->get()]() { return std::optional<double>(simulated->progress()); };
  Result<PoseFile> truth = PoseFile::open();
  if (!truth) return truth.error();
  input.truth = KnownTruth{[simulated = link->get()](DeviceTime at) { return simulated->T_world_body(at); },
                           std::move(truth).value()};
  input.link = std::move(link).value();
  return std::unique_ptr<SampleSource>(std::make_unique<LinkSampleSource>(std::move(input)));
}

}  // namespace

Result<std::unique_ptr<SampleSource>> open_sample_source(const std::string& uri,
                                                         const SampleSourceOptions& options) {
  const Status checked = check_options(options);
  if (!checked) return checked.error();
  const Result<InputUri> parsed = parse_input_uri(uri);
  if (!parsed) return parsed.error();
  switch (parsed->kind) {
    case InputUri::Kind::kFile:
      return open_file(parsed->path, options);
    case InputUri::Kind::kSimulation:
      return open_simulation(uri, *parsed, options);
    default:
      return open_live(uri, *parsed, options);
  }
}

}  // namespace swiftlet
