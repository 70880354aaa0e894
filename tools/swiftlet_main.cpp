// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors

// The swiftlet command line. Exit code 0: done; 2: bad input of any kind, with one line on stderr. And 1
// of `swiftlet doctor`: it has found a problem.

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/sensing/range_sample.hpp"
#include "daemon/command_line.hpp"
#include "daemon/manual/page_option.hpp"
#include "daemon/outputs/output_directory.hpp"
#include "daemon/system/named_file.hpp"
#include "daemon/system/thread_setup.hpp"
#include "daemon/version.hpp"
#include "firmware_link/input/input_uri.hpp"
#include "firmware_link/simulation/address.hpp"
#include "firmware_link/simulation/flight.hpp"
#include "firmware_link/simulation/world.hpp"
#include "tools/calibrate_command.hpp"
#include "tools/convert_command.hpp"
#include "tools/doctor_command.hpp"
#include "tools/eval_command.hpp"
#include "tools/flights_command.hpp"
#include "tools/latency_command.hpp"
#include "tools/map_command.hpp"
#include "tools/record_command.hpp"
#include "tools/sim_command.hpp"
#include "tools/tell_command.hpp"
#include "tools/view_command.hpp"

namespace {

using swiftlet::InputNature;

constexpr int kExitProblemFound = 1;
constexpr int kExitBadInput = 2;

int refuse(std::string message) {
  for (char& c : message)
    if (c == '\n') c = ' ';
  std::fprintf(stderr, "swiftlet: %s\n", message.c_str());
  return kExitBadInput;
}

/// What ends of itself.
std::string finite_inputs() { return swiftlet::input_forms({InputNature::kSimulation, InputNature::kFile}); }

std::string worlds_text() {
  std::string text = "Worlds:";
  for (const swiftlet::WorldPlan& world : swiftlet::simulated_worlds())
    text.append("\n  ").append(world.name).append(": ").append(world.text);
  return text;
}

/// As in sim://WORLD?seed=N; CLI11 alone takes -1 for the greatest number and 010 for eight.
CLI::Validator seed_of_address() {
  const auto take = [](std::string& text) {
    const swiftlet::Result<std::uint64_t> seed = swiftlet::parse_seed(text);
    if (!seed) return seed.error().message;
    text = std::to_string(*seed);
    return std::string();
  };
  return {take, ""};
}

CLI::App* add_map_command(CLI::App& app, swiftlet::MapCommand& command) {
  CLI::App* map =
      app.add_subcommand("map", "Take a whole input through the pipeline and write map and trajectory");
  map->add_option("INPUT", command.input, finite_inputs())->required();
  map->add_option("-o,--output", command.output_directory,
                  "Directory for the outputs, created where missing; without it a new folder in " +
                      std::string(swiftlet::kFlightsDirectory));
  map->add_option("--config", command.config_file, "TOML file with settings")->check(swiftlet::named_file());
  map->add_option("--beams", command.beams, "Laser logs: how many beams to keep")
      ->check(CLI::Range(2, static_cast<int>(swiftlet::kMaxBeams)));
  map->add_flag_callback(
      "--no-calibrate", [&command] { command.calibrate = false; },
      "Take the sensors as expected: do not estimate age of the ranges and scales of the odometry first");
  CLI::Option* odometry =
      map->add_flag("--odometry-only", command.odometry_only, "Correct nothing: a baseline");
  map->add_flag("--frontend-only", command.frontend_only, "Walls but no loop closures: a baseline")
      ->excludes(odometry);
  map->add_flag("--plan", command.plan, "Also draw the walls alone: plan.png");
  map->footer(worlds_text());
  return map;
}

CLI::App* add_sim_command(CLI::App& app, swiftlet::SimCommand& command) {
  CLI::App* sim = app.add_subcommand(
      "sim", "Put a simulated vehicle on UDP, to practise on; reads instructions from stdin, try help");
  sim->add_option("--world", command.world, "One of those below")->capture_default_str();
  sim->add_option("--seed", command.seed, "Of all noise: the same seed is the same vehicle")
      ->transform(seed_of_address())
      ->capture_default_str();
  sim->add_option("--udp", command.udp, "ADDRESS:PORT to listen on")->capture_default_str();
  sim->add_option("--laps", command.laps, "How often to fly the world's script before landing")
      ->check(CLI::Range(1, swiftlet::kMaxLaps))
      ->capture_default_str();
  sim->add_option("--battery", command.battery_minutes,
                  "Minutes in the air until it is empty; without it, 8 a lap")
      ->check(swiftlet::number_from(0.1, 1000.0));
  sim->add_option("--clock-start", command.clock_start_s, "Seconds on the vehicle's clock at first")
      ->check(swiftlet::number_from(0.0, 1e6));
  sim->add_option("--loss", command.loss_percent, "Percent of packets lost, each way")
      ->check(swiftlet::number_from(0.0, 100.0));
  sim->add_option("--delay", command.delay_ms, "Milliseconds that packets from the vehicle take")
      ->check(swiftlet::number_from(0.0, 60'000.0));
  sim->add_option("--duplicates", command.duplicates_percent, "Percent of packets from the vehicle doubled")
      ->check(swiftlet::number_from(0.0, 100.0));
  sim->add_flag("--steered", command.steered, "Fly by a client's hover setpoints, not by the world's script");
  sim->add_option("--missing-deck", command.missing_decks, "flow or multiranger; may be given twice");
  sim->footer(worlds_text());
  return sim;
}

CLI::App* add_record_command(CLI::App& app, swiftlet::RecordCommand& command) {
  CLI::App* record =
      app.add_subcommand("record", "Record what a vehicle sends, to be replayed or mapped later");
  record
      ->add_option("INPUT", command.input,
                   swiftlet::input_forms({InputNature::kVehicle, InputNature::kSimulation}))
      ->required();
  record->add_option("-o,--output", command.file, "The recording, a .pcap file that is not there yet")
      ->required();
  record->add_option("--seconds", command.seconds, "End after this long; without it, at Ctrl-C")
      ->check(swiftlet::number_from(0.001, 1e6));
  return record;
}

CLI::App* add_doctor_command(CLI::App& app, swiftlet::DoctorCommand& command) {
  CLI::App* doctor = app.add_subcommand(
      "doctor",
      "Check dongle, vehicle, LCM and this machine before a flight; exit code 1 when something stops it");
  doctor->add_option("INPUT", command.input, swiftlet::input_forms({InputNature::kVehicle}))
      ->capture_default_str();
  doctor->add_option("--lcm-url", command.lcm_url, "Where swiftletd is to publish")
      ->envname("LCM_DEFAULT_URL")
      ->capture_default_str();
  doctor->add_flag("--json", command.json, "For programs");
  return doctor;
}

CLI::App* add_eval_command(CLI::App& app, swiftlet::EvalCommand& command) {
  CLI::App* eval = app.add_subcommand("eval", "Hold a trajectory against what is known of the truth");
  eval->add_option("TRAJECTORY", command.trajectory,
                   "A TUM file: trajectory.tum of a run; with --live an input, which is mapped")
      ->required();
  eval->add_option("REFERENCE", command.references,
                   "Relations (Kuemmerle 2009), a true trajectory (TUM) or the flight's capture (.pcap), by "
                   "content");
  eval->add_option("--relations", command.relations, "A reference that is relations; may be given twice")
      ->allow_extra_args(false);
  eval->add_option("--truth", command.truths, "A reference that is a true trajectory; may be given twice")
      ->allow_extra_args(false);
  CLI::Option* live = eval->add_flag("--live,--consistency", command.live,
                                     "Hold the poses published on the way against the map of that moment; "
                                     "the reference is the true path or, "
                                     "without one, the final path");
  eval->add_option("--batch", command.batch_s,
                   "With --live: also runs that end at such poses, every so many seconds")
      ->check(swiftlet::number_from(0.001, 1e6))
      ->needs(live);
  eval->add_option("--config", command.config_file, "With --live: TOML file with settings")
      ->check(swiftlet::named_file())
      ->needs(live);
  eval->add_flag_callback(
          "--no-calibrate", [&command] { command.calibrate = false; },
          "With --live: do not estimate age and scales first; swiftletd cannot, either")
      ->needs(live);
  eval->add_option("--json", command.json_file, "Write all figures to this file; - for stdout, not the table")
      ->check(swiftlet::named_file());
  return eval;
}

CLI::App* add_calibrate_command(CLI::App& app, swiftlet::CalibrateCommand& command) {
  CLI::App* calibrate = app.add_subcommand(
      "calibrate", "Estimate from one run how old its ranges are and how its dead reckoning errs");
  calibrate->add_option("LOG", command.input, finite_inputs())->required();
  calibrate
      ->add_option("-o,--output", command.toml_file,
                   "Write what matters to this TOML file, for --config; it must not be there yet")
      ->check(swiftlet::named_file());
  calibrate->add_option("--beams", command.beams, "Laser logs: how many beams to keep")
      ->check(CLI::Range(2, static_cast<int>(swiftlet::kMaxBeams)));
  calibrate->add_flag("--json", command.json, "For programs");
  return calibrate;
}

CLI::App* add_convert_command(CLI::App& app, swiftlet::ConvertCommand& command) {
  CLI::App* convert =
      app.add_subcommand("convert", "Write an input, or what is made of it, for other programs");
  convert
      ->add_option("INPUT", command.input,
                   finite_inputs() + "; " + swiftlet::kLcmInput + " a running swiftletd, to .mcap")
      ->required();
  convert
      ->add_option(
          "OUTPUT", command.output,
          "The file to write, by its ending: .csv samples, which swiftlet reads back; .g2o pose graph; "
          ".mcap run for Foxglove")
      ->required();
  convert->add_option("--config", command.config_file, "TOML file with settings")
      ->check(swiftlet::named_file());
  convert->add_option("--beams", command.beams, "Laser logs: how many beams to keep")
      ->check(CLI::Range(2, static_cast<int>(swiftlet::kMaxBeams)));
  convert->add_flag_callback(
      "--no-calibrate", [&command] { command.calibrate = false; },
      "As of swiftlet map: take the sensors as expected");
  convert->add_option("--lcm-url", command.lcm_url, "With lcm: where swiftletd publishes")
      ->envname("LCM_DEFAULT_URL")
      ->capture_default_str();
  convert->add_option("--channel-prefix", command.channel_prefix, "With lcm: as in swiftletd's configuration")
      ->capture_default_str();
  return convert;
}

CLI::App* add_flights_command(CLI::App& app, swiftlet::FlightsCommand& command) {
  CLI::App* flights =
      app.add_subcommand("flights", "List the flights whose outputs have folders of their own");
  flights->add_option("DIRECTORY", command.directory, "Where the folders are")->capture_default_str();
  return flights;
}

CLI::App* add_latency_command(CLI::App& app, swiftlet::LatencyCommand& command) {
  CLI::App* latency = app.add_subcommand(
      "latency", "Show how a run kept time: from radio frame to published pose, each stage, each queue");
  latency->add_option("REPORT", command.report_file, "report.json of a run");
  latency->add_option("--picture", command.picture_file, "Draw the histograms to this PNG file")
      ->check(swiftlet::named_file());
  latency->add_flag("--listen", command.listen, "Listen to a running swiftletd instead");
  latency->add_option("--lcm-url", command.lcm_url, "Where it publishes")
      ->envname("LCM_DEFAULT_URL")
      ->capture_default_str();
  latency->add_option("--channel-prefix", command.channel_prefix, "As in its configuration")
      ->capture_default_str();
  return latency;
}

CLI::App* add_view_command(CLI::App& app, swiftlet::ViewCommand& command) {
  CLI::App* view =
      app.add_subcommand("view", "Show the live map of a running swiftletd, or a recording, in a browser");
  CLI::Option* input =
      view->add_option("INPUT", command.input,
                       "To be mapped and shown; without it a running swiftletd is.\n" + finite_inputs())
          ->check(swiftlet::named_file());
  view->add_option("--listen", command.listen, "ADDRESS:PORT where the browser finds the page")
      ->capture_default_str();
  view->add_option("--allow-origin", command.foreign_origins,
                   "Let pages from there look, too, as their browser names it: https://app.foxglove.dev, or "
                   "file:// for Foxglove's desktop application; may be given twice")
      ->allow_extra_args(false);
  view->add_option("--lcm-url", command.lcm_url, "Where swiftletd publishes")
      ->envname("LCM_DEFAULT_URL")
      ->capture_default_str();
  view->add_option("--channel-prefix", command.channel_prefix, "As in swiftletd's configuration")
      ->capture_default_str();
  view->add_option("--rate", command.rate, "Play the input at this many times its pace")
      ->check(swiftlet::number_from(0.1, 1000.0))
      ->needs(input);
  view->add_option("--config", command.config_file, "For the input: TOML file with settings")
      ->check(swiftlet::named_file())
      ->needs(input);
  view->add_option("--beams", command.beams, "Laser logs: how many beams to keep")
      ->check(CLI::Range(2, static_cast<int>(swiftlet::kMaxBeams)))
      ->needs(input);
  return view;
}

CLI::App* add_tell_command(CLI::App& app, swiftlet::TellCommand& command) {
  CLI::App* tell = app.add_subcommand("tell", "Send a command to a running swiftletd --commands");
  tell->add_option("WHAT", command.what, "save-map, mark-place or new-map")
      ->check(CLI::IsMember({"save-map", "mark-place", "new-map"}))
      ->required();
  tell->add_option("NAME", command.name, "Of the place to mark");
  tell->add_option("--to", command.to, "ADDRESS:PORT where swiftletd takes commands")->capture_default_str();
  tell->add_option("--channel-prefix", command.channel_prefix, "As in swiftletd's configuration")
      ->capture_default_str();
  return tell;
}

CLI::App* add_help_command(CLI::App& app, std::string& command) {
  CLI::App* help = app.add_subcommand("help", "Print the options of a command");
  help->add_option("COMMAND", command, "One of those that swiftlet --help lists");
  return help;
}

int run_help(const CLI::App& app, const std::string& command) {
  if (command.empty()) {
    // app.help() would be that of the command help.
    const std::string all = app.get_formatter()->make_help(&app, app.get_name(), CLI::AppFormatMode::Normal);
    std::fputs(all.c_str(), stdout);
    return 0;
  }
  const auto is_named = [&command](const CLI::App* candidate) { return candidate->get_name() == command; };
  const std::vector<const CLI::App*> named = app.get_subcommands(is_named);
  if (named.empty()) return refuse("no command '" + command + "'; see swiftlet --help");
  std::fputs(named.front()->help("swiftlet").c_str(), stdout);
  return 0;
}

/// What is wrong with the command line, and for a command that lacks something how to write it.
std::string fault_of(const CLI::App& app, const CLI::ParseError& error) {
  static const std::map<std::string, std::string> kExamples{
      {"map", "swiftlet map flight.pcap -o out"},
      {"record", "swiftlet record radio://0/80/2M/E7E7E7E7E7 -o flight.pcap"},
      {"eval", "swiftlet eval out/trajectory.tum truth.tum"},
      {"calibrate", "swiftlet calibrate flight.pcap"},
      {"convert", "swiftlet convert flight.pcap flight.csv"},
      {"tell", "swiftlet tell mark-place kitchen"}};
  const std::vector<CLI::App*> named = app.get_subcommands();
  if (named.empty() && app.remaining_size() > 0)
    return "no command '" + app.remaining().front() + "'; see swiftlet --help";
  const bool lacks_something = dynamic_cast<const CLI::RequiredError*>(&error) != nullptr;
  if (named.empty() && lacks_something) return "no command given; see swiftlet --help";
  if (named.empty()) return std::string(error.what()) + "; see swiftlet --help";
  const std::string command = named.front()->get_name();
  const auto example = kExamples.find(command);
  if (lacks_something && example != kExamples.end())
    return command + ": " + error.what() + "; for example: " + example->second;
  return command + ": " + error.what() + "; see swiftlet help " + command;
}

int run_doctor(const swiftlet::DoctorCommand& command) {
  const swiftlet::Result<bool> ready = swiftlet::run_doctor_command(command);
  if (!ready) return refuse(ready.error().message);
  return *ready ? 0 : kExitProblemFound;
}

/// What each command was asked to do.
struct Commands {
  swiftlet::MapCommand map;
  swiftlet::SimCommand sim;
  swiftlet::RecordCommand record;
  swiftlet::DoctorCommand doctor;
  swiftlet::EvalCommand eval;
  swiftlet::CalibrateCommand calibrate;
  swiftlet::ConvertCommand convert;
  swiftlet::FlightsCommand flights;
  swiftlet::LatencyCommand latency;
  swiftlet::ViewCommand view;
  swiftlet::TellCommand tell;
  std::string help;  ///< of this command; empty: of all
};

struct Choice {
  const CLI::App* command;
  std::function<int()> run;  ///< gives the exit code
};

/// In the order in which help lists them. `app` and `commands` must outlive the choices.
std::vector<Choice> add_commands(CLI::App& app, Commands& commands) {
  const auto done = [](const swiftlet::Status& status) {
    return status ? 0 : refuse(status.error().message);
  };
  Commands& c = commands;
  return {{add_map_command(app, c.map), [&c, done] { return done(swiftlet::run_map_command(c.map)); }},
          {add_sim_command(app, c.sim),
           [&c, done] {
             swiftlet::outlive_readers();
             return done(swiftlet::run_sim_command(c.sim));
           }},
          {add_record_command(app, c.record),
           [&c, done] {
             swiftlet::outlive_readers();
             return done(swiftlet::run_record_command(c.record));
           }},
          {add_doctor_command(app, c.doctor), [&c] { return run_doctor(c.doctor); }},
          {add_eval_command(app, c.eval), [&c, done] { return done(swiftlet::run_eval_command(c.eval)); }},
          {add_calibrate_command(app, c.calibrate),
           [&c, done] { return done(swiftlet::run_calibrate_command(c.calibrate)); }},
          {add_convert_command(app, c.convert),
           [&c, done] { return done(swiftlet::run_convert_command(c.convert)); }},
          {add_flights_command(app, c.flights),
           [&c, done] { return done(swiftlet::run_flights_command(c.flights)); }},
          {add_latency_command(app, c.latency),
           [&c, done] { return done(swiftlet::run_latency_command(c.latency)); }},
          {add_view_command(app, c.view), [&c, done] { return done(swiftlet::run_view_command(c.view)); }},
          {add_tell_command(app, c.tell), [&c, done] { return done(swiftlet::run_tell_command(c.tell)); }},
          {add_help_command(app, c.help), [&c, &app] { return run_help(app, c.help); }}};
}

/// What the manual page has beyond --help.
swiftlet::ManualFacts manual_facts(const std::vector<Choice>& choices) {
  swiftlet::ManualFacts facts{
      .section = 1, .version = swiftlet::version_text("swiftlet"), .sections = {}, .choices = {}};
  for (const swiftlet::WorldPlan& world : swiftlet::simulated_worlds())
    facts.choices["--world"].emplace_back(world.name);
  facts.choices["--missing-deck"] = {"flow", "multiranger"};
  for (const Choice& choice : choices) facts.choices["COMMAND"].push_back(choice.command->get_name());
  facts.sections["EXIT STATUS"] =
      "0: done.\n1: swiftlet doctor found a problem that stops a flight.\n2: bad input; one line on stderr "
      "says what.";
  facts.sections["SEE ALSO"] = "swiftletd(8), /usr/share/doc/swiftlet";
  return facts;
}

int run(int argc, char** argv) {
  CLI::App app("2D SLAM for four range beams");
  app.name("swiftlet");
  app.set_version_flag("--version", swiftlet::version_text("swiftlet"));
  app.require_subcommand(1);
  Commands commands;
  const std::vector<Choice> choices = add_commands(app, commands);
  swiftlet::add_page_option(app, manual_facts(choices));
  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& question) {
    return swiftlet::answer(app, question);
  } catch (const CLI::ParseError& error) {
    return refuse(fault_of(app, error));
  }
  const auto is_chosen = [](const Choice& choice) { return choice.command->parsed(); };
  return std::ranges::find_if(choices, is_chosen)->run();  // there is one: it is required
}

}  // namespace

int main(int argc, char** argv) {
  swiftlet::take_file_size_limit_as_error();
  swiftlet::keep_freed_memory();
  try {
    const int exit_code = run(argc, argv);
    const std::optional<std::string> failure = swiftlet::output_failure();
    return failure ? refuse(*failure) : exit_code;
  } catch (const std::exception& error) {  // out of memory, or a fault of the standard library's
    return refuse(error.what());
  }
}
