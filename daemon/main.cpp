// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/spdlog.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <csignal>
#include <cstdio>
#include <exception>
#include <memory>
#include <string>

#include "daemon/command_line.hpp"
#include "daemon/config/configuration.hpp"
#include "daemon/manual/page_option.hpp"
#include "daemon/program/options.hpp"
#include "daemon/program/runs.hpp"
#include "daemon/system/log_file.hpp"
#include "daemon/system/signal_watcher.hpp"
#include "daemon/system/terminal.hpp"
#include "daemon/system/thread_setup.hpp"
#include "daemon/version.hpp"

namespace swiftlet {
namespace {

Result<Configuration> read_configuration(const Options& options) {
  if (options.config_path.empty()) return Configuration{};
  return load_configuration(options.config_path);
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

int run(const Options& options) {
  const Result<Configuration> config = read_configuration(options);
  if (!config) return refuse(config.error().message);
  const Result<std::unique_ptr<LogFile>> log = open_log(options);
  if (!log) return refuse(log.error().message);
  const SignalWatcher signals = watch_signals(log->get());  // before the threads, libusb's too
  return run_until_over(options, *config, signals.token());
}

int main_without_exceptions(int argc, char** argv) {
  outlive_readers();
  take_file_size_limit_as_error();
  keep_freed_memory();
  Options options;
  CLI::App app("swiftletd: maps a building live from four range beams, and publishes over LCM");
  app.name("swiftletd");
  app.set_version_flag("--version", version_text("swiftletd"));
  declare_options(app, options);
  add_page_option(app, manual_facts());
  try {
    app.parse(argc, argv);
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
  complete_options(app, options);
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
