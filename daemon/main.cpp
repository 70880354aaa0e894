// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/spdlog.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "daemon/command_line.hpp"
#include "daemon/commands/command_executor.hpp"
#include "daemon/commands/command_listener.hpp"
#include "daemon/commands/numbered_path.hpp"
#include "daemon/config/configuration.hpp"
#include "daemon/daemon.hpp"
#include "daemon/manual/page_option.hpp"
#include "daemon/outputs/map_notes.hpp"
#include "daemon/outputs/output_directory.hpp"
#include "daemon/outputs/peak_memory.hpp"
#include "daemon/outputs/run_outputs.hpp"
#include "daemon/publish/lcm_publisher.hpp"
#include "daemon/publish/lcm_transport.hpp"
#include "daemon/recording/recorder.hpp"
#include "daemon/recording/recording_plan.hpp"
#include "daemon/system/log_file.hpp"
#include "daemon/system/named_file.hpp"
#include "daemon/system/service_manager.hpp"
#include "daemon/system/signal_watcher.hpp"
#include "daemon/system/terminal.hpp"
#include "daemon/version.hpp"
#include "daemon/view/live_view.hpp"
#include "daemon/workers/pruned_scans.hpp"
#include "firmware_link/input/input_uri.hpp"
#include "firmware_link/input/open_sample_source.hpp"
#include "firmware_link/link/udp_address.hpp"

namespace swiftlet {
namespace {

constexpr int kBadInput = 2;
constexpr std::string_view kUdpScheme = "udp://";
constexpr const char* kShareHere = "udp://127.0.0.1:19850";
constexpr const char* kViewHere = "127.0.0.1:8440";
constexpr const char* kCommandsHere = "127.0.0.1:8450";

struct Options {
  std::string config_path;
  std::string input_uri;
  std::string lcm_url = kDefaultLcmUrl;
  std::string compat;
  double rate = 1.0;
  std::optional<int> beams;
  std::optional<std::string> output_directory;
  bool no_output = false;
  std::string log_file;
  RecordingWish record;
  std::optional<std::string> share;
  std::optional<std::string> view;
  std::optional<std::string> commands;
  bool print_reference = false;
  bool print_tuning = false;
  bool verbose = false;
};

void declare(CLI::App& app, Options& options) {
  app.add_option("--config", options.config_path, "TOML file; docs/configuration.md lists its keys")
      ->check(named_file());
  using enum InputNature;
  app.add_option("INPUT,--input", options.input_uri, input_forms({kVehicle, kSimulation, kFile, kFollowed}));
  app.add_option("--lcm-url", options.lcm_url, "where to publish")
      ->envname("LCM_DEFAULT_URL")
      ->capture_default_str();
  app.add_option("--compat", options.compat, "publish pose, beams and map as these programs have them, too")
      ->check(CLI::IsMember({"mbot"}));
  app.add_option("--rate", options.rate, "replay this many times as fast as recorded")
      ->check(number_from(0.001, 1e6))
      ->capture_default_str();
  app.add_option("--beams", options.beams, "laser logs: how many beams to keep");
  CLI::Option* output =
      app.add_option("-o,--output", options.output_directory,
                     "write map, trajectories and report here at the end; without it to a new folder in " +
                         std::string(kFlightsDirectory));
  app.add_flag("--no-output", options.no_output, "write none of them")->excludes(output);
  CLI::Option* record =
      app.add_option("--record", options.record.file,
                     "record the flight to this file; without FILE, or without --record from a live link, to "
                     "the state directory")
          ->type_name("[FILE]")
          ->expected(0, 1);
  app.add_flag("--no-record", options.record.refused, "record nothing")->excludes(record);
  app.add_option("--share", options.share,
                 "let one other program use the vehicle too, and fly it; without ADDRESS on this machine "
                 "alone, on udp://127.0.0.1:19850")
      ->type_name("[ADDRESS]")
      ->expected(0, 1);
  app.add_option(
         "--view", options.view,
         "show the map while it grows, to browsers; without ADDRESS:PORT to those on this machine, on "
         "http://127.0.0.1:8440")
      ->type_name("[ADDRESS:PORT]")
      ->expected(0, 1);
  app.add_option("--commands", options.commands,
                 "take commands from programs on this machine: save the map, mark a place, begin a new map; "
                 "without ADDRESS:PORT on 127.0.0.1:8450")
      ->type_name("[ADDRESS:PORT]")
      ->expected(0, 1);
  app.add_option("--log-file", options.log_file,
                 "log there, not to stderr; SIGHUP opens it anew, for whoever rotates logs, instead of "
                 "ending the run")
      ->check(named_file());
  app.add_flag("-v,--verbose", options.verbose, "log each status");
  app.add_flag("--print-configuration-reference", options.print_reference,
               "write docs/configuration.md and exit");
  app.add_flag("--print-tuning", options.print_tuning)->group("");  // for experiments: not in the help
}

/// What the manual page has beyond --help.
ManualFacts manual_facts() {
  return {
      .section = 8,
      .version = version_text("swiftletd"),
      .sections =
          {{"EXIT STATUS",
            "0: the run is complete.\n1: an internal failure.\n2: bad input or configuration; one line on "
            "stderr says what."},
           {"FILES",
            "/etc/swiftlet/swiftletd.toml: the configuration of the service.\n"
            "/etc/default/swiftletd: the input and the LCM address of the service.\n"
            "/var/lib/swiftlet: recordings of the service."},
           {"SEE ALSO", "swiftlet(1), systemctl(1), /usr/share/doc/swiftlet"}},
      .choices = {}};
}

int refuse(const std::string& why) {
  std::fprintf(stderr, "swiftletd: %s\n", why.c_str());
  return kBadInput;
}

Result<Configuration> read_configuration(const Options& options) {
  if (options.config_path.empty()) return Configuration{};
  return load_configuration(options.config_path);
}

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
    return Error{ErrorCode::kInvalidInput,
                 fmt::format("--share {}: write {}127.0.0.1:19850", text, kUdpScheme)};
  text.remove_prefix(kUdpScheme.size());
  Result<UdpAddress> address = parse_udp_address(text);
  if (!address) return Error{ErrorCode::kInvalidInput, "--share: " + address.error().message};
  const UdpAddress* const vehicle = input ? input->as<UdpAddress>() : nullptr;
  if (vehicle != nullptr && is_own_client(*vehicle, *address))
    return Error{ErrorCode::kInvalidInput,
                 fmt::format("--share {}{}: INPUT is at that port; choose another one", kUdpScheme, text)};
  return std::optional<UdpAddress>(std::move(address).value());
}

void tell_share(const UdpAddress& address) {
  spdlog::info("shared: one client may connect to {}{}:{}", kUdpScheme, address.host, address.port);
  if (!address.host.starts_with("127.") && address.host != "localhost")
    spdlog::warn("shared beyond this machine: whoever reaches {}:{} can fly the vehicle", address.host,
                 address.port);
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
  Result<std::unique_ptr<SampleSource>> opened = open_sample_source(options.input_uri, source);
  if (opened && source.share) tell_share(*source.share);
  return opened;
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
  const WebServer& server = (*view)->server();
  spdlog::info("the live map: open {} in a browser", server.url());
  if (server.is_beyond_this_machine())
    spdlog::warn("shown beyond this machine: whoever reaches {} sees the map", server.url());
  return view;
}

/// The way in for commands; nullptr: they are not asked for. Errors: as CommandListener::open.
Result<std::unique_ptr<CommandListener>> open_commands(const Options& options, const Configuration& config) {
  if (!options.commands) return std::unique_ptr<CommandListener>();
  Result<std::unique_ptr<CommandListener>> listener =
      CommandListener::open(*options.commands, config.publish.channel_prefix + "COMMAND");
  if (listener) spdlog::info("commands are taken on {}", (*listener)->url());
  return listener;
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

/// nullptr: the log goes to stderr.
Result<std::unique_ptr<LogFile>> open_log(const Options& options) {
  if (options.log_file.empty()) return std::unique_ptr<LogFile>();
  return LogFile::open(options.log_file);
}

SignalWatcher watch_signals(LogFile* log) {
  if (log == nullptr) return SignalWatcher();
  return SignalWatcher([log] { log->reopen(); });
}

bool is_followed(const Options& options) {
  const Result<InputUri> input = parse_input_uri(options.input_uri);
  return input && input->is(InputNature::kFollowed);
}

/// A live link keeps its own pace and cannot be asked to wait; a recording that is still written does and
/// can.
InputPolicy input_policy(const Options& options, const SampleSource& source) {
  if (source.is_live()) return {.rate = {}, .refuses_when_full = true};
  if (is_followed(options)) return {.rate = {}};
  return {.rate = options.rate};
}

std::string input_text(const Options& options, const SampleSource& source) {
  if (source.is_live() || is_followed(options)) return options.input_uri + " (until stopped by a signal)";
  return fmt::format("{} at {} times its pace", options.input_uri, options.rate);
}

/// One line for each problem of the input, and for each note from `first_note` on; its exit code.
int log_problems(const Options& options, const Daemon& daemon, const InputReport& report,
                 std::size_t first_note, const Status& outcome) {
  int exit_code = 0;
  for (std::size_t i = first_note; i < report.notes.size(); ++i) spdlog::info("{}", report.notes[i]);
  for (const std::string& problem : report.problems) exit_code = refuse(problem);
  if (!outcome) exit_code = refuse(outcome.error().message);
  if (daemon.pipeline().backend().scans().size() == 0 && exit_code == 0)
    exit_code = refuse(options.input_uri + ": held no usable sample");
  return exit_code;
}

/// Where a run writes to.
struct Outputs {
  OutputDirectory directory;
  PrunedScans pruned;
};

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

Status write_outputs(const Outputs* outputs, const Options& options, const Configuration& config,
                     const Daemon& daemon, const SampleSource& source,
                     const std::vector<MarkedPlace>& places) {
  if (outputs == nullptr || daemon.pipeline().backend().scans().size() == 0) return {};
  const std::filesystem::path& directory = outputs->directory.path();
  spdlog::info("writing {}", directory.string());
  const Result<WrittenOutputs> written =
      write_run_outputs(directory, {.backend = daemon.pipeline().backend(),
                                    .map = daemon.pipeline().map(),
                                    .input = source.report(),
                                    .frontend = daemon.pipeline().frontend().counters(),
                                    .timing = daemon.pipeline().timing(),
                                    .truth = source.ground_truth(),
                                    .input_uri = options.input_uri,
                                    .sensor = config.sensor.applied_to(source.sensor()),
                                    .pruned = &outputs->pruned,
                                    .places = places,
                                    .peak_memory_mb = peak_memory_mb()});
  if (!written) return written.error();
  if (const auto note = replacement_note(directory, *written)) spdlog::info("{}", *note);
  return {};
}

/// Until the recording is on the disk, too.
Status run_recorded(Daemon& daemon, Recorder* recorder, const std::stop_token& stop) {
  std::optional<RecorderThread> thread;
  if (recorder != nullptr) {
    spdlog::info("recording to {}", recorder->path());
    thread.emplace(*recorder);
    daemon.report_recording([recorder] {
      return RecordingFigures{recorder->failed() ? RecordingState::kFailed : RecordingState::kRunning,
                              recorder->bytes()};
    });
  }
  return daemon.run(stop);
}

/// What a run reads, writes and serves, in the order in which it is opened.
struct RunParts {
  std::unique_ptr<Recorder> recorder;
  std::unique_ptr<SampleSource> source;
  std::unique_ptr<Outputs> outputs;
  std::unique_ptr<LiveView> view;
  std::unique_ptr<LcmTransport> lcm;
  std::unique_ptr<Publisher> publisher;
  std::unique_ptr<CommandListener> commands;
};

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

/// What becomes of commands; `over` ends the run.
CommandExecutor make_executor(const RunParts& run, Daemon& daemon, std::stop_source& over) {
  CommandExecutor::Run of_commands{.directory = {}, .is_live = run.source->is_live(), .end = [&] {
                                     daemon.announce_next_run();
                                     over.request_stop();
                                   }};
  if (run.outputs) of_commands.directory = run.outputs->directory.path();
  return CommandExecutor(std::move(of_commands));
}

/// How a run ended.
struct RunEnd {
  int exit_code = 0;
  bool wants_new_map = false;
};

/// Writes down what is left of the run when its threads have ended.
int finish_run(const Options& options, const Configuration& config, const RunParts& run, const Daemon& daemon,
               const std::vector<MarkedPlace>& places, const Status& outcome) {
  const BackendCounters& counters = daemon.pipeline().backend().counters();
  spdlog::info("{} samples, {} keyframes, {} loop closures ({} of them dropped)", counters.scans,
               counters.keyframes, counters.closures_accepted, counters.closures_dropped);
  for (const std::string& note : map_notes(counters)) spdlog::info("{}", note);
  const Status written = write_outputs(run.outputs.get(), options, config, daemon, *run.source, places);
  // A live vehicle's notes are the events that were logged when they happened.
  const InputReport& report = run.source->report();
  const std::size_t first_note = run.source->is_live() ? report.notes.size() : 0;
  int exit_code = log_problems(options, daemon, report, first_note, outcome);
  for (const Status& kept : {written, run.lcm->check_log()})
    if (!kept) exit_code = refuse(kept.error().message);
  return exit_code;
}

RunEnd run_once(const Options& options, const Configuration& config, const std::stop_token& signalled) {
  RunParts run;
  if (const Status opened = open_parts(options, config, run); !opened)
    return {.exit_code = refuse(opened.error().message)};
  SteadyClock clock;
  Daemon daemon(config, *run.source, clock, input_policy(options, *run.source), *run.publisher);
  if (run.outputs) daemon.keep_pruned(run.outputs->pruned);
  spdlog::info("{}, publishing on {}", input_text(options, *run.source), options.lcm_url);
  const ServiceManager service_manager;
  daemon.report_to(service_manager);
  std::stop_source over;
  const std::stop_callback at_signal(signalled, [&over] { over.request_stop(); });
  CommandExecutor executor = make_executor(run, daemon, over);
  daemon.execute_commands_by(
      [&executor](const Command& command, const MapBuilder& map, std::optional<HostTime> newest) {
        executor.execute(command, map, newest);
      });
  if (run.commands)
    run.commands->start([&daemon](const Command& command) { return daemon.command(command); });
  const Status outcome = run_recorded(daemon, run.recorder.get(), over.get_token());
  if (run.commands) run.commands->stop();
  if (signalled.stop_requested()) spdlog::info("stopped by a signal");
  return {.exit_code = finish_run(options, config, run, daemon, executor.places(), outcome),
          .wants_new_map = executor.wants_new_map()};
}

Options options_of_run(const Options& options, int number) {
  Options of_run = options;
  if (number == 1) return of_run;
  if (options.output_directory) of_run.output_directory = numbered_path(*options.output_directory, number);
  if (!options.record.file.empty()) of_run.record.file = numbered_path(options.record.file, number);
  of_run.lcm_url = numbered_lcm_url(options.lcm_url, number);
  return of_run;
}

int run(const Options& options) {
  const Result<Configuration> config = read_configuration(options);
  if (!config) return refuse(config.error().message);
  const Result<std::unique_ptr<LogFile>> log = open_log(options);
  if (!log) return refuse(log.error().message);
  const SignalWatcher signals = watch_signals(log->get());  // before the threads, libusb's too
  int exit_code = 0;                                        // the worst of all runs
  for (int number = 1;; ++number) {
    const RunEnd end = run_once(options_of_run(options, number), *config, signals.token());
    exit_code = std::max(exit_code, end.exit_code);
    if (!end.wants_new_map || signals.token().stop_requested()) return exit_code;
  }
}

/// An option that takes a word may have taken INPUT for it.
std::string why_no_input(const Options& options) {
  const auto taken = [](const std::string& text, std::string_view value, std::string_view option) {
    return fmt::format("{} is taken for the {} of {}; name INPUT before {}", text, value, option, option);
  };
  const auto is_uri = [](const std::string& text) { return text.find("://") != std::string::npos; };
  const auto is_no_address = [](const std::string& text) {
    return !text.empty() && !parse_listen_address(text);
  };
  const std::string share = options.share.value_or("");
  const std::string view = options.view.value_or("");
  const std::string commands = options.commands.value_or("");
  if (is_uri(options.record.file)) return taken(options.record.file, "file", "--record");
  if (is_uri(share)) return taken(share, "address", "--share");
  if (is_no_address(view)) return taken(view, "address", "--view");
  if (is_no_address(commands)) return taken(commands, "address", "--commands");
  return "no INPUT is named; for example: swiftletd radio://0/80/2M/E7E7E7E7E7 -o out";
}

/// Of options that were given without one.
void name_addresses(const CLI::App& app, Options& options) {
  const auto name = [&app](const char* option, const char* here, std::optional<std::string>& address) {
    if (app.count(option) > 0 && address.value_or("").empty()) address = here;
  };
  name("--share", kShareHere, options.share);
  name("--view", kViewHere, options.view);
  name("--commands", kCommandsHere, options.commands);
}

int main_without_exceptions(int argc, char** argv) {
  // Whoever read the log may be gone (a pipe to a program that the same Ctrl-C ended): write the outputs.
  static_cast<void>(std::signal(SIGPIPE, SIG_IGN));
  Options options;
  CLI::App app("swiftletd: maps a building live from four range beams, and publishes over LCM");
  app.name("swiftletd");
  app.set_version_flag("--version", version_text("swiftletd"));
  declare(app, options);
  add_page_option(app, manual_facts());
  try {
    app.parse(argc, argv);
    options.record.asked = app.count("--record") > 0;
  } catch (const CLI::Success& question) {
    return answer(app, question);
  } catch (const CLI::ParseError& error) {
    return refuse(std::string(error.what()) + "; --help lists the options");
  }
  if (options.print_reference) {
    std::fputs(configuration_reference().c_str(), stdout);
    return 0;
  }
  if (options.print_tuning) {
    std::fputs(tuning_text({}).c_str(), stdout);
    return 0;
  }
  if (options.input_uri.empty()) return refuse(why_no_input(options));
  name_addresses(app, options);
  const auto colours = wants_colours(STDERR_FILENO) ? spdlog::color_mode::always : spdlog::color_mode::never;
  spdlog::set_default_logger(spdlog::stderr_color_mt("swiftletd", colours));
  spdlog::set_level(options.verbose ? spdlog::level::debug : spdlog::level::info);
  return run(options);
}

}  // namespace
}  // namespace swiftlet

int main(int argc, char** argv) {
  try {
    const int exit_code = swiftlet::main_without_exceptions(argc, argv);
    const auto failure = swiftlet::output_failure();
    return failure ? swiftlet::refuse(*failure) : exit_code;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "swiftletd: %s\n", error.what());
    return 1;
  }
}
