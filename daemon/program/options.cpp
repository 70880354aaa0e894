// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "daemon/program/options.hpp"

#include <fmt/format.h>

#include <cstdio>
#include <filesystem>
#include <string_view>
#include <system_error>

#include "daemon/command_line.hpp"
#include "daemon/commands/numbered_path.hpp"
#include "daemon/outputs/output_directory.hpp"
#include "daemon/publish/lcm_url.hpp"
#include "daemon/system/default_addresses.hpp"
#include "daemon/system/named_file.hpp"
#include "daemon/version.hpp"
#include "daemon/view/live_view.hpp"
#include "firmware_link/input/input_uri.hpp"
#include "firmware_link/link/udp_address.hpp"

namespace swiftlet {
namespace {

constexpr int kBadInput = 2;

/// What lies there would keep a later run from beginning, or would be lost.
bool is_taken(const Options& options, const Options& first) {
  const auto is_there = [](const std::string& file) {
    std::error_code ignored;
    return !file.empty() && std::filesystem::exists(file, ignored);
  };
  const auto holds_anything = [](const std::filesystem::path& directory) {
    std::error_code ignored;
    return std::filesystem::is_directory(directory, ignored) &&
           !std::filesystem::is_empty(directory, ignored);
  };
  const std::optional<std::string>& output = options.output_directory;
  const Result<LcmUrl> lcm = parse_lcm_url(options.lcm_url);
  return is_there(options.record.file) || (options.lcm_url != first.lcm_url && lcm && is_there(lcm->file)) ||
         (output && (holds_anything(*output) || is_being_written_to(*output)));
}

/// Refuses the URL of a log that LCM would read.
CLI::Validator written_log() {
  const auto refusal = [](const std::string& url) {
    const Result<LcmUrl> lcm = parse_lcm_url(url);
    const bool is_read = lcm && !lcm->file.empty() && !lcm->writes_file;
    return is_read ? "'" + url + "' would be read; write 'file://" + lcm->file + "?mode=w'" : std::string();
  };
  return {refusal, ""};
}

}  // namespace

void declare_options(CLI::App& app, Options& options) {
  app.add_option("--config", options.config_path, "TOML file; docs/configuration.md lists its keys")
      ->check(named_file());
  using enum InputNature;
  app.add_option("INPUT,--input", options.input_uri, input_forms({kVehicle, kSimulation, kFile, kFollowed}));
  app.add_option("--lcm-url", options.lcm_url, "where to publish")
      ->envname("LCM_DEFAULT_URL")
      ->check(written_log())
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
  app.add_option(
         "--share", options.share,
         "let one other program use the vehicle too, and fly it; without ADDRESS on this machine alone, on " +
             std::string(kLocalUdpUri))
      ->type_name("[ADDRESS]")
      ->expected(0, 1);
  app.add_option("--view", options.view,
                 "show the map while it grows, to browsers; without ADDRESS:PORT to those on this machine, "
                 "on http://" +
                     on_this_machine(kViewPort))
      ->type_name("[ADDRESS:PORT]")
      ->expected(0, 1);
  app.add_option("--commands", options.commands,
                 "take commands from programs on this machine: save the map, mark a place, begin a new map; "
                 "without ADDRESS:PORT on " +
                     on_this_machine(kCommandsPort))
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

void complete_options(const CLI::App& app, Options& options) {
  const auto name = [&app](const char* option, const std::string& here, std::optional<std::string>& address) {
    if (app.count(option) > 0 && address.value_or("").empty()) address = here;
  };
  options.record.asked = app.count("--record") > 0;
  name("--share", kLocalUdpUri, options.share);
  name("--view", on_this_machine(kViewPort), options.view);
  name("--commands", on_this_machine(kCommandsPort), options.commands);
}

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

bool is_followed(const Options& options) {
  const Result<InputUri> input = parse_input_uri(options.input_uri);
  return input && input->is(InputNature::kFollowed);
}

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

Options options_of_run(const Options& options, int& number) {
  Options of_run = options;
  for (;; ++number) {
    if (options.output_directory) of_run.output_directory = numbered_path(*options.output_directory, number);
    if (!options.record.file.empty()) of_run.record.file = numbered_path(options.record.file, number);
    of_run.lcm_url = numbered_lcm_url(options.lcm_url, number);
    if (!is_taken(of_run, options)) return of_run;
  }
}

int refuse(const std::string& why) {
  std::fprintf(stderr, "swiftletd: %s\n", why.c_str());
  return kBadInput;
}

}  // namespace swiftlet
