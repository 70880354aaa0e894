// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "daemon/program/run_parts.hpp"

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <chrono>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>

#include "daemon/publish/lcm_publisher.hpp"
#include "firmware_link/input/input_uri.hpp"
#include "firmware_link/input/open_sample_source.hpp"
#include "firmware_link/link/udp_address.hpp"

namespace swiftlet {
namespace {

/// The recorder of this run, if it has any. Errors: as Recorder::open, where a recording was asked for; a
/// recording by custom is only warned about.
Result<std::unique_ptr<Recorder>> open_recorder(const Options& options, const Configuration& config) {
  const Result<InputUri> input = parse_input_uri(options.input_uri);
  if (!input) return input.error();
  const HostTime now(std::chrono::system_clock::now().time_since_epoch());
  const Result<std::optional<RecordingPlan>> plan =
      plan_recording(*input, options.record, config.record, now);
  if (plan && !*plan) return std::unique_ptr<Recorder>();
  const RecorderVoice voice{
      .note = [](const std::string& text) { spdlog::info("{}", text); },
      .problem = [](const std::string& text) { spdlog::error("{}; the flight goes on", text); }};
  Result<std::unique_ptr<Recorder>> recorder =
      plan ? Recorder::open(**plan, voice) : Result<std::unique_ptr<Recorder>>(plan.error());
  if (recorder || options.record.asked) return recorder;
  spdlog::warn("this flight is not recorded: {}", recorder.error().message);
  return std::unique_ptr<Recorder>();
}

/// Whether a link to `vehicle` would end at our own socket on `share`.
bool is_own_client(const UdpAddress& vehicle, const UdpAddress& share) {
  const auto number = [](const std::string& host) { return host == "localhost" ? "127.0.0.1" : host; };
  return share.port == vehicle.port &&
         (share.host == "0.0.0.0" || number(share.host) == number(vehicle.host));
}

/// Where a client may connect. The configuration counts for live vehicles alone. Error: kInvalidInput: it is
/// no address, or the vehicle's.
Result<std::optional<UdpAddress>> share_address(const Options& options, const Configuration& config) {
  std::string_view text = options.share ? *options.share : config.share.address;
  const Result<InputUri> input = parse_input_uri(options.input_uri);
  const bool is_live = input && input->is(InputNature::kVehicle);
  if (text.empty() || (!options.share && !is_live)) return std::optional<UdpAddress>();
  if (!text.starts_with(kUdpScheme))
    return Error{ErrorCode::kInvalidInput, fmt::format("--share {}: write {}", text, kLocalUdpUri)};
  text.remove_prefix(kUdpScheme.size());
  Result<UdpAddress> address = parse_udp_address(text);
  if (!address) return Error{ErrorCode::kInvalidInput, "--share: " + address.error().message};
  const UdpAddress* const vehicle = input ? input->as<UdpAddress>() : nullptr;
  if (vehicle != nullptr && is_own_client(*vehicle, *address))
    return Error{ErrorCode::kInvalidInput,
                 fmt::format("--share {}{}: INPUT is at that port; choose another one", kUdpScheme, text)};
  return std::optional<UdpAddress>(std::move(address).value());
}

Result<std::unique_ptr<SampleSource>> open_input(const Options& options, const Configuration& config,
                                                 FrameSink* recording) {
  SampleSourceOptions source;
  source.recording = recording;
  source.may_follow = true;
  Result<std::optional<UdpAddress>> share = share_address(options, config);
  if (!share) return share.error();
  source.share = std::move(share).value();
  source.beam_count = options.beams;
  if (config.sensor.range_age_s) source.range_age = from_seconds(*config.sensor.range_age_s);
  source.max_range_m = config.sensor.max_range_m;
  source.min_range_m = config.sensor.min_range_m;
  return open_sample_source(options.input_uri, source);
}

/// The page of this run; nullptr: it is not asked for. Errors: as LiveView::open.
Result<std::unique_ptr<LiveView>> open_view(const Options& options, const Configuration& config) {
  const std::string text = options.view.value_or(config.view.address);
  if (text.empty()) return std::unique_ptr<LiveView>();
  const std::string asked_by = options.view ? "--view: " : "view.address: ";
  const Result<ListenAddress> address = parse_listen_address(text);
  if (!address) return Error{ErrorCode::kInvalidInput, asked_by + address.error().message};
  Result<std::unique_ptr<LiveView>> view =
      LiveView::open(*address, {.title = options.input_uri}, config.publish.channel_prefix);
  if (!view) return Error{ErrorCode::kInvalidInput, asked_by + view.error().message};
  return view;
}

/// The way in for commands; nullptr: they are not asked for. Errors: as CommandListener::open.
Result<std::unique_ptr<CommandListener>> open_commands(const Options& options, const Configuration& config) {
  if (!options.commands) return std::unique_ptr<CommandListener>();
  return CommandListener::open(*options.commands, config.publish.channel_prefix + "COMMAND");
}

/// Names the run for consumers: the time it began, in microseconds since 1970.
std::int64_t new_map_id() {
  const auto now = std::chrono::system_clock::now().time_since_epoch();
  return std::chrono::duration_cast<std::chrono::microseconds>(now).count();
}

/// Also to the page, where there is one; `lcm` and `view` must outlive the publisher.
std::unique_ptr<Publisher> make_publisher(const Options& options, const Configuration& config,
                                          LcmTransport& lcm, LiveView* view) {
  MessageSink also;
  if (view != nullptr)
    also = [view](const std::string& channel, std::span<const std::uint8_t> message) {
      view->take(channel, message);
      return true;
    };
  const Compatibility compatibility = options.compat == "mbot" ? Compatibility::kMbot : Compatibility::kNone;
  return make_lcm_publisher(lcm, config.publish.channel_prefix, new_map_id(), std::move(also), compatibility);
}

/// Before the flight, so that it does not end at a closed door. nullptr: the user wants none.
Result<std::unique_ptr<Outputs>> prepare_outputs(const Options& options) {
  if (options.no_output) return std::unique_ptr<Outputs>();
  const HostTime now(std::chrono::system_clock::now().time_since_epoch());
  Result<OutputDirectory> directory =
      OutputDirectory::of_run(options.output_directory, options.input_uri, now);
  if (!directory) return directory.error();
  Result<PrunedScans> pruned = PrunedScans::open(directory->path());
  if (!pruned) return pruned.error();
  return std::make_unique<Outputs>(
      Outputs{.directory = std::move(directory).value(), .pruned = std::move(pruned).value()});
}

template <typename Part>
Status take(Result<Part> opened, Part& part) {
  if (!opened) return opened.error();
  part = std::move(opened).value();
  return {};
}

Status open_parts(const Options& options, const Configuration& config, RunParts& run) {
  Status opened = take(open_recorder(options, config), run.recorder);
  if (opened)
    opened = take(open_input(options, config, run.recorder ? &run.recorder->sink() : nullptr), run.source);
  if (opened) opened = take(prepare_outputs(options), run.outputs);
  if (opened) opened = take(open_view(options, config), run.view);
  if (opened) opened = take(LcmTransport::open(options.lcm_url), run.lcm);
  if (opened) run.publisher = make_publisher(options, config, *run.lcm, run.view.get());
  if (opened) opened = take(open_commands(options, config), run.commands);
  return opened;
}

void tell_share(const UdpAddress& address) {
  spdlog::info("shared: one client may connect to {}{}:{}", kUdpScheme, address.host, address.port);
  if (!address.host.starts_with("127.") && address.host != "localhost")
    spdlog::warn("shared beyond this machine: whoever reaches {}:{} can fly the vehicle", address.host,
                 address.port);
}

void tell_view(const WebServer& server) {
  spdlog::info("the live map: open {} in a browser", server.url());
  if (server.is_beyond_this_machine())
    spdlog::warn("shown beyond this machine: whoever reaches {} sees the map", server.url());
}

/// Once all is open: one that cannot begin yet is opened again and again.
void tell_ways_in(const RunParts& run, const std::optional<UdpAddress>& share) {
  if (share) tell_share(*share);
  if (run.view) tell_view(run.view->server());
  if (run.commands) spdlog::info("commands are taken on {}", run.commands->url());
}

}  // namespace

Result<std::unique_ptr<RunParts>> RunParts::open(const Options& options, const Configuration& config) {
  auto run = std::make_unique<RunParts>();
  if (const Status opened = open_parts(options, config, *run); !opened) return opened.error();
  tell_ways_in(*run, *share_address(options, config));
  return run;
}

}  // namespace swiftlet
