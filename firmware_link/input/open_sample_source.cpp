// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "firmware_link/input/open_sample_source.hpp"

#include <cmath>
#include <cstddef>
#include <utility>

#include "core/base/settings.hpp"
#include "core/sensing/systematic_motion.hpp"
#include "firmware_link/capture/followed_link.hpp"
#include "firmware_link/capture/replay_link.hpp"
#include "firmware_link/file/input_file.hpp"
#include "firmware_link/input/faulty_sample_source.hpp"
#include "firmware_link/input/input_uri.hpp"
#include "firmware_link/input/link_sample_source.hpp"
#include "firmware_link/laser_log/carmen_sample_source.hpp"
#include "firmware_link/sample/motion_mending_source.hpp"
#include "firmware_link/sample_table/client_table_link.hpp"
#include "firmware_link/sample_table/flight_table_source.hpp"
#include "firmware_link/sample_table/sample_table_source.hpp"
#include "firmware_link/sharing/client_socket.hpp"
#include "firmware_link/sharing/shared_link.hpp"
#include "firmware_link/simulation/address.hpp"

namespace swiftlet {
namespace {

Status check_options(const SampleSourceOptions& options) {
  if (options.beam_count && (*options.beam_count < 2 || *options.beam_count > static_cast<int>(kMaxBeams)))
    return Error{ErrorCode::kInvalidInput, "--beams " + std::to_string(*options.beam_count) +
                                               ": must be from 2 to " + std::to_string(kMaxBeams)};
  if (options.range_age && (*options.range_age < kMinRangeAge || *options.range_age > kMaxRangeAge))
    return Error{ErrorCode::kInvalidInput, "range age " + std::to_string(to_seconds(*options.range_age)) +
                                               " s: must be from " + shortest_text(to_seconds(kMinRangeAge)) +
                                               " to " + shortest_text(to_seconds(kMaxRangeAge)) + " s"};
  if (options.max_range_m && !(*options.max_range_m > 0.0 && std::isfinite(*options.max_range_m)))
    return Error{ErrorCode::kInvalidInput,
                 "maximum range " + std::to_string(*options.max_range_m) + " m: must be positive"};
  return {};
}

/// Limits as given, or the sensor's own: there must be ranges between them.
Status check_limits(const SampleSourceOptions& options, const SensorModel& usual) {
  const double min_m = options.min_range_m.value_or(usual.min_range_m);
  const double max_m = options.max_range_m.value_or(usual.max_range_m);
  if (min_m < max_m) return {};
  return Error{ErrorCode::kInvalidInput, "minimum range " + std::to_string(min_m) +
                                             " m: must be less than the maximum, here " +
                                             std::to_string(max_m) + " m"};
}

/// What the options change about any link.
Status apply(const SampleSourceOptions& options, LinkInput& input) {
  if (Status limits = check_limits(options, input.sensor); !limits) return limits;
  if (options.range_age) input.sensor.range_age = *options.range_age;
  if (options.max_range_m) input.sensor.max_range_m = *options.max_range_m;
  if (options.min_range_m) input.sensor.min_range_m = *options.min_range_m;
  if (options.beam_count) input.notes.emplace_back(kBeamsIgnored);
  return {};
}

/// By the description beside a capture, if there is one; that of a packed capture has the plain one's name.
Status describe(const std::string& path, LinkInput& input) {
  const std::string plain = path.ends_with(".gz") ? path.substr(0, path.size() - 3) : path;
  Result<BlockDescription> description = read_block_description(plain + ".toml");
  if (description)
    input.description = std::move(description).value();
  else if (description.error().code != ErrorCode::kNotFound)
    return description.error();
  return {};
}

Result<LinkInput> capture_input(const std::string& path, const SampleSourceOptions& options,
                                std::unique_ptr<ReplayLink> link) {
  LinkInput input;
  input.name = path;
  if (const Status applied = apply(options, input); !applied) return applied.error();
  for (const std::string& note : link->notes()) input.notes.push_back(note);
  input.progress = [replay = link.get()]() { return std::optional<double>(replay->progress()); };
  input.link = std::move(link);
  if (const Status described = describe(path, input); !described) return described.error();
  return input;
}

/// Which vehicle a capture's error is about, where it has several.
std::string named_vehicle(const ReplayLink& link) {
  std::string others;
  for (const CaptureVehicle& vehicle : link.left_out())
    others += (others.empty() ? "" : ", ") + vehicle.text();
  if (others.empty()) return {};
  return " (of " + link.followed().text() + "; cannot be mapped either: " + others + ")";
}

/// Of the first vehicle that can be mapped.
Result<std::unique_ptr<SampleSource>> open_capture(const std::string& path,
                                                   const SampleSourceOptions& options) {
  std::optional<Error> first_failure;
  for (std::size_t passed_over = 0;; ++passed_over) {
    Result<std::unique_ptr<ReplayLink>> link = ReplayLink::open(path, passed_over);
    if (!link) return link.error();
    const bool is_last = passed_over + 1 >= (*link)->senders();
    const std::string vehicle = named_vehicle(**link);
    Result<LinkInput> input = capture_input(path, options, std::move(link).value());
    if (!input) return input.error();
    auto source = std::make_unique<LinkSampleSource>(std::move(input).value());
    const Status found = source->find_first_sample();
    if (found) return std::unique_ptr<SampleSource>(std::move(source));
    if (!first_failure) first_failure = Error{found.error().code, found.error().message + vehicle};
    if (is_last) return *first_failure;
  }
}

Result<std::unique_ptr<SampleSource>> open_client_table(const std::string& path,
                                                        const SampleSourceOptions& options) {
  Result<std::unique_ptr<ClientTableLink>> link = ClientTableLink::open(path);
  if (!link) return link.error();
  LinkInput input;
  input.name = path;
  if (const Status applied = apply(options, input); !applied) return applied.error();
  input.description = (*link)->description();
  input.link = std::move(link).value();
  auto source = std::make_unique<LinkSampleSource>(std::move(input));
  if (const Status found = source->find_first_sample(); !found) return found.error();
  return std::unique_ptr<SampleSource>(std::move(source));
}

/// Without waiting for its first sample.
Result<std::unique_ptr<SampleSource>> open_followed(const std::string& path,
                                                    const SampleSourceOptions& options) {
  if (!options.may_follow)
    return Error{ErrorCode::kInvalidInput,
                 path + ": only swiftletd follows a recording that is still written"};
  Result<std::unique_ptr<FollowedLink>> link = FollowedLink::open(path);
  if (!link) return link.error();
  LinkInput input;
  input.name = path;
  if (const Status applied = apply(options, input); !applied) return applied.error();
  input.link = std::move(link).value();
  if (const Status described = describe(path, input); !described) return described.error();
  return std::unique_ptr<SampleSource>(std::make_unique<LinkSampleSource>(std::move(input)));
}

Result<std::unique_ptr<SampleSource>> open_flight_table(const std::string& path,
                                                        const SampleSourceOptions& options) {
  if (const Status limits = check_limits(options, SensorModel::crazyflie()); !limits) return limits.error();
  return FlightTableSource::open(path, options);
}

Result<std::unique_ptr<SampleSource>> open_file(const std::string& path, const SampleSourceOptions& options) {
  const Result<std::uint64_t> size = size_of_input_file(path);
  if (!size) return size.error();
  if (begins_like_capture(path) || path.ends_with(".pcap") || path.ends_with(".pcap.gz"))
    return open_capture(path, options);
  if (is_client_table(path)) return open_client_table(path, options);
  if (is_flight_table(path)) return open_flight_table(path, options);
  if (is_taken_for_sample_table(path)) return SampleTableSource::open(path, options);
  const Status limits = check_limits(options, SensorModel::carmen_laser());
  if (!limits) return limits.error();
  return CarmenSampleSource::open(path, options);
}

Status share(LinkInput& input, const UdpAddress& address) {
  Result<std::unique_ptr<ClientSocket>> socket = ClientSocket::open(address);
  if (!socket) return socket.error();
  auto shared = std::make_unique<SharedLink>(std::move(input.link), std::move(socket).value(), *input.clock);
  input.shared = shared.get();
  input.link = std::move(shared);
  return {};
}

Result<std::unique_ptr<SampleSource>> open_link(const std::string& name, const InputUri& uri,
                                                const SampleSourceOptions& options) {
  const auto* simulation = uri.as<SimulationAddress>();
  const bool breaks = simulation != nullptr && !simulation->faults.empty();
  if (breaks && options.recording != nullptr)
    return Error{
        ErrorCode::kInvalidInput,
        name +
            ": its faults are made behind the link, a recording would not have them; convert it to a "
            "table (.csv), which has"};
  Result<LinkInput> opened = uri.kind->open(uri.address);
  if (!opened) return opened.error();
  LinkInput input = std::move(opened).value();
  input.name = name;
  if (const Status applied = apply(options, input); !applied) return applied.error();
  if (options.share)
    if (const Status shared = share(input, *options.share); !shared) return shared.error();
  input.recording = options.recording;
  input.starts_logging = true;
  if (uri.is(InputNature::kVehicle)) input.cache_directory = TocCache::default_directory();
  std::unique_ptr<SampleSource> source = std::make_unique<LinkSampleSource>(std::move(input));
  if (!breaks) return source;
  return std::unique_ptr<SampleSource>(
      std::make_unique<FaultySampleSource>(std::move(source), simulation->faults));
}

Result<std::unique_ptr<SampleSource>> open_as_reported(const std::string& uri,
                                                       const SampleSourceOptions& options) {
  const Status checked = check_options(options);
  if (!checked) return checked.error();
  const Result<InputUri> parsed = parse_input_uri(uri);
  if (!parsed) return parsed.error();
  if (options.share && !parsed->is(InputNature::kVehicle))
    return Error{ErrorCode::kInvalidInput, uri + ": only the link to a live vehicle can be shared"};
  if (parsed->is(InputNature::kFollowed)) return open_followed(parsed->as<InputFile>()->path, options);
  if (const auto* file = parsed->as<InputFile>()) return open_file(file->path, options);
  return open_link(uri, *parsed, options);
}

}  // namespace

Result<std::unique_ptr<SampleSource>> open_sample_source(const std::string& uri,
                                                         const SampleSourceOptions& options) {
  Result<std::unique_ptr<SampleSource>> source = open_as_reported(uri, options);
  if (!source || !options.mends_motion || yaw_goes_with_travel((*source)->sensor().odometry)) return source;
  return std::unique_ptr<SampleSource>(std::make_unique<MotionMendingSource>(std::move(source).value()));
}

}  // namespace swiftlet
