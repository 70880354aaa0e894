// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/spdlog.h>

#include <CLI/CLI.hpp>
#include <chrono>
#include <cstdio>
#include <exception>
#include <memory>
#include <optional>
#include <string>

#include "daemon/configuration_fields.hpp"
#include "daemon/daemon.hpp"
#include "daemon/lcm_publisher.hpp"
#include "daemon/outputs/file_writer.hpp"
#include "daemon/outputs/run_outputs.hpp"
#include "daemon/signal_watcher.hpp"

namespace swiftlet {
namespace {

constexpr int kBadInput = 2;

struct Options {
  std::string config_path;
  std::string input_uri;
  std::string lcm_url = "udpm://239.255.76.67:7667?ttl=0";
  double rate = 1.0;
  std::optional<int> beams;
  std::string output_directory;
  bool print_reference = false;
  bool verbose = false;
};

void declare(CLI::App& app, Options& options) {
  app.add_option("--config", options.config_path, "TOML file; docs/configuration.md lists its keys");
  app.add_option(
      "--input", options.input_uri,
      "radio://0/80/2M/E7E7E7E7E7, usb://0, udp://HOST:PORT, replay:FILE.pcap, sim://WORLD?seed=N, or a "
      ".pcap or .clf[.gz] file");
  app.add_option("--lcm-url", options.lcm_url, "where to publish")
      ->envname("LCM_DEFAULT_URL")
      ->capture_default_str();
  app.add_option("--rate", options.rate, "replay this many times as fast as recorded")
      ->check(CLI::Range(0.001, 1e6))
      ->capture_default_str();
  app.add_option("--beams", options.beams, "laser logs: how many beams to keep");
  app.add_option("-o,--output", options.output_directory,
                 "write map, trajectories and report here at the end");
  app.add_flag("-v,--verbose", options.verbose, "log each status");
  app.add_flag("--print-configuration-reference", options.print_reference,
               "write docs/configuration.md and exit");
}

int refuse(const std::string& why) {
  std::fprintf(stderr, "swiftletd: %s\n", why.c_str());
  return kBadInput;
}

Result<Configuration> read_configuration(const Options& options) {
  if (options.config_path.empty()) return Configuration{};
  return load_configuration(options.config_path);
}

Result<std::unique_ptr<SampleSource>> open_input(const Options& options, const Configuration& config) {
  SampleSourceOptions source;
  source.beam_count = options.beams;
  if (config.sensor.range_age_s) source.range_age = from_seconds(*config.sensor.range_age_s);
  source.max_range_m = config.sensor.max_range_m;
  source.min_range_m = config.sensor.min_range_m;
  return open_sample_source(options.input_uri, source);
}

/// A live link keeps its own pace and cannot be asked to wait.
InputPolicy input_policy(const Options& options, const SampleSource& source) {
  if (source.is_live()) return {.rate = {}, .refuses_when_full = true};
  return {.rate = options.rate};
}

std::string input_text(const Options& options, const SampleSource& source) {
  if (source.is_live()) return options.input_uri + " (until stopped by a signal)";
  return fmt::format("{} at {} times its pace", options.input_uri, options.rate);
}

/// Names the run for consumers: the time it began, in microseconds since 1970.
std::int64_t new_map_id() {
  const auto now = std::chrono::system_clock::now().time_since_epoch();
  return std::chrono::duration_cast<std::chrono::microseconds>(now).count();
}

/// One line for each problem of the input; its exit code.
int tell_problems(const Options& options, const Daemon& daemon, const InputReport& report,
                  const Status& outcome) {
  int exit_code = 0;
  for (const std::string& note : report.notes) spdlog::info("{}", note);
  for (const std::string& problem : report.problems) exit_code = refuse(problem);
  if (!outcome) exit_code = refuse(outcome.error().message);
  if (daemon.pipeline().backend().scans().size() == 0 && exit_code == 0)
    exit_code = refuse(options.input_uri + ": held no usable sample");
  return exit_code;
}

Status write_outputs(const Options& options, const Configuration& config, const Daemon& daemon,
                     const SampleSource& source) {
  if (options.output_directory.empty() || daemon.pipeline().backend().scans().size() == 0) return {};
  spdlog::info("writing {}", options.output_directory);
  return write_run_outputs(options.output_directory, {.backend = daemon.pipeline().backend(),
                                                      .map = daemon.pipeline().map(),
                                                      .input = source.report(),
                                                      .frontend = daemon.pipeline().frontend().counters(),
                                                      .times = daemon.pipeline().stage_times(),
                                                      .truth = source.ground_truth(),
                                                      .input_uri = options.input_uri,
                                                      .sensor = config.sensor.applied_to(source.sensor())});
}

int run(const Options& options) {
  const Result<Configuration> config = read_configuration(options);
  if (!config) return refuse(config.error().message);
  if (!options.output_directory.empty()) {
    const Status ready = prepare_output_directory(options.output_directory);
    if (!ready) return refuse(ready.error().message);
  }
  const Result<std::unique_ptr<SampleSource>> source = open_input(options, *config);
  if (!source) return refuse(source.error().message);
  const Result<std::unique_ptr<LcmPublisher>> publisher =
      LcmPublisher::open(options.lcm_url, config->publish.channel_prefix, new_map_id());
  if (!publisher) return refuse(publisher.error().message);

  const SignalWatcher signals;  // before the threads
  SteadyClock clock;
  Daemon daemon(*config, **source, clock, input_policy(options, **source), **publisher);
  spdlog::info("{}, publishing on {}", input_text(options, **source), options.lcm_url);
  const Status outcome = daemon.run(signals.token());
  if (signals.token().stop_requested()) spdlog::info("stopped by a signal");
  const BackendCounters& counters = daemon.pipeline().backend().counters();
  spdlog::info("{} samples, {} keyframes, {} loop closures ({} of them dropped)", counters.scans,
               counters.keyframes, counters.closures_accepted, counters.closures_dropped);
  const Status written = write_outputs(options, *config, daemon, **source);
  const int exit_code = tell_problems(options, daemon, (*source)->report(), outcome);
  return written ? exit_code : refuse(written.error().message);
}

int main_without_exceptions(int argc, char** argv) {
  Options options;
  CLI::App app("swiftletd: maps a building live from four range beams, and publishes over LCM");
  declare(app, options);
  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& help) {
    return app.exit(help);
  } catch (const CLI::ParseError& error) {
    return refuse(std::string(error.what()) + "; --help lists the options");
  }
  if (options.print_reference) {
    std::fputs(configuration_reference().c_str(), stdout);
    return 0;
  }
  if (options.input_uri.empty()) return refuse("--input is required; --help lists the options");
  spdlog::set_default_logger(spdlog::stderr_color_mt("swiftletd"));
  spdlog::set_level(options.verbose ? spdlog::level::debug : spdlog::level::info);
  return run(options);
}

}  // namespace
}  // namespace swiftlet

int main(int argc, char** argv) {
  try {
    return swiftlet::main_without_exceptions(argc, argv);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "swiftletd: %s\n", error.what());
    return 1;
  }
}
