// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors

// The swiftlet command line. Exit code 0: done; 2: bad input of any kind, said in one line on stderr. And 1
// of `swiftlet doctor`: it has found a problem.

#include <CLI/CLI.hpp>
#include <cstdio>
#include <exception>
#include <string>

#include "core/sensing/range_sample.hpp"
#include "firmware_link/input/input_uri.hpp"
#include "firmware_link/simulation/flight.hpp"
#include "firmware_link/simulation/world.hpp"
#include "tools/calibrate_command.hpp"
#include "tools/doctor_command.hpp"
#include "tools/eval_command.hpp"
#include "tools/latency_command.hpp"
#include "tools/map_command.hpp"
#include "tools/record_command.hpp"
#include "tools/sim_command.hpp"

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

CLI::App* add_map_command(CLI::App& app, swiftlet::MapCommand& command) {
  CLI::App* map =
      app.add_subcommand("map", "Take a whole input through the pipeline and write map and trajectory");
  map->add_option("INPUT", command.input, finite_inputs())->required();
  map->add_option("-o,--output", command.output_directory, "Directory for the outputs, created where missing")
      ->required();
  map->add_option("--config", command.config_file, "TOML file with settings");
  map->add_option("--beams", command.beams, "Laser logs: how many beams to keep")
      ->check(CLI::Range(2, static_cast<int>(swiftlet::kMaxBeams)));
  map->add_flag_callback(
      "--no-calibrate", [&command] { command.calibrate = false; },
      "Take the sensors as expected: do not estimate age of the ranges and scales of the odometry first");
  CLI::Option* odometry =
      map->add_flag("--odometry-only", command.odometry_only, "Correct nothing: a baseline");
  map->add_flag("--frontend-only", command.frontend_only, "Walls but no loop closures: a baseline")
      ->excludes(odometry);
  map->footer(worlds_text());
  return map;
}

CLI::App* add_sim_command(CLI::App& app, swiftlet::SimCommand& command) {
  CLI::App* sim = app.add_subcommand(
      "sim", "Put a simulated vehicle on UDP, to practise on; reads instructions from stdin, try help");
  sim->add_option("--world", command.world, "One of those below")->capture_default_str();
  sim->add_option("--seed", command.seed, "Of all noise: the same seed is the same vehicle")
      ->capture_default_str();
  sim->add_option("--udp", command.udp, "ADDRESS:PORT to listen on")->capture_default_str();
  sim->add_option("--laps", command.laps, "How often to fly the world's script before landing")
      ->check(CLI::Range(1, swiftlet::kMaxLaps))
      ->capture_default_str();
  sim->add_option("--battery", command.battery_minutes,
                  "Minutes in the air until it is empty; without it, 8 a lap")
      ->check(CLI::Range(0.1, 1000.0));
  sim->add_option("--clock-start", command.clock_start_s, "Seconds on the vehicle's clock at first")
      ->check(CLI::Range(0.0, 1e6));
  sim->add_option("--loss", command.loss_percent, "Percent of packets lost, each way")
      ->check(CLI::Range(0.0, 100.0));
  sim->add_option("--delay", command.delay_ms, "Milliseconds that packets from the vehicle take")
      ->check(CLI::Range(0.0, 60'000.0));
  sim->add_option("--duplicates", command.duplicates_percent, "Percent of packets from the vehicle doubled")
      ->check(CLI::Range(0.0, 100.0));
  sim->add_flag("--steered", command.steered, "Fly by a client's hover setpoints, not by the world's script");
  sim->add_option("--missing-deck", command.missing_decks, "flow or multiranger; may be given twice");
  sim->footer(worlds_text());
  return sim;
}

CLI::App* add_record_command(CLI::App& app, swiftlet::RecordCommand& command) {
  CLI::App* record =
      app.add_subcommand("record", "Record what a vehicle says, to be replayed or mapped later");
  record
      ->add_option("INPUT", command.input,
                   swiftlet::input_forms({InputNature::kVehicle, InputNature::kSimulation}))
      ->required();
  record->add_option("-o,--output", command.file, "The recording, a .pcap file that is not there yet")
      ->required();
  record->add_option("--seconds", command.seconds, "End after this long; without it, at Ctrl-C")
      ->check(CLI::PositiveNumber);
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
  eval->add_option(
      "REFERENCE", command.references,
      "Relations (Kuemmerle 2009), a true trajectory (TUM) or the flight's capture (.pcap), told "
      "by content");
  eval->add_option("--relations", command.relations, "A reference that is relations; may be given twice")
      ->allow_extra_args(false);
  eval->add_option("--truth", command.truths, "A reference that is a true trajectory; may be given twice")
      ->allow_extra_args(false);
  CLI::Option* live = eval->add_flag("--live", command.live,
                                     "Hold the poses published on the way against the map of that moment; "
                                     "the reference is the true path or, "
                                     "without one, the final path");
  eval->add_option("--batch", command.batch_s,
                   "With --live: also runs that end at such poses, every so many seconds")
      ->check(CLI::PositiveNumber)
      ->needs(live);
  eval->add_option("--config", command.config_file, "With --live: TOML file with settings")->needs(live);
  eval->add_option("--json", command.json_file,
                   "Write all figures to this file; - for stdout, not the table");
  return eval;
}

CLI::App* add_calibrate_command(CLI::App& app, swiftlet::CalibrateCommand& command) {
  CLI::App* calibrate = app.add_subcommand(
      "calibrate", "Tell from one run how old its ranges are and how its dead reckoning errs");
  calibrate->add_option("LOG", command.input, finite_inputs())->required();
  calibrate->add_option("-o,--output", command.toml_file,
                        "Write what matters to this TOML file, for --config; it must not be there yet");
  calibrate->add_option("--beams", command.beams, "Laser logs: how many beams to keep")
      ->check(CLI::Range(2, static_cast<int>(swiftlet::kMaxBeams)));
  calibrate->add_flag("--json", command.json, "For programs");
  return calibrate;
}

CLI::App* add_latency_command(CLI::App& app, swiftlet::LatencyCommand& command) {
  CLI::App* latency = app.add_subcommand(
      "latency", "Tell how a run kept time: from radio frame to published pose, each stage, each queue");
  latency->add_option("REPORT", command.report_file, "report.json of a run");
  latency->add_option("--picture", command.picture_file, "Draw the histograms to this PNG file");
  latency->add_flag("--listen", command.listen, "Listen to a running swiftletd instead");
  latency->add_option("--lcm-url", command.lcm_url, "Where it publishes")
      ->envname("LCM_DEFAULT_URL")
      ->capture_default_str();
  latency->add_option("--channel-prefix", command.channel_prefix, "As in its configuration")
      ->capture_default_str();
  return latency;
}

int run_doctor(const swiftlet::DoctorCommand& command) {
  const swiftlet::Result<bool> ready = swiftlet::run_doctor_command(command);
  if (!ready) return refuse(ready.error().message);
  return *ready ? 0 : kExitProblemFound;
}

int run(int argc, char** argv) {
  CLI::App app("2D SLAM for four range beams");
  app.name("swiftlet");
  app.set_version_flag("--version", SWIFTLET_VERSION);
  app.require_subcommand(1);
  swiftlet::MapCommand map_command;
  const CLI::App* map = add_map_command(app, map_command);
  swiftlet::SimCommand sim_command;
  const CLI::App* sim = add_sim_command(app, sim_command);
  swiftlet::RecordCommand record_command;
  const CLI::App* record = add_record_command(app, record_command);
  swiftlet::DoctorCommand doctor_command;
  const CLI::App* doctor = add_doctor_command(app, doctor_command);
  swiftlet::EvalCommand eval_command;
  const CLI::App* eval = add_eval_command(app, eval_command);
  swiftlet::CalibrateCommand calibrate_command;
  const CLI::App* calibrate = add_calibrate_command(app, calibrate_command);
  swiftlet::LatencyCommand latency_command;
  const CLI::App* latency = add_latency_command(app, latency_command);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) return app.exit(error);  // --help, --version
    const bool is_unknown = app.get_subcommands().empty() && app.remaining_size() > 0;
    const std::string what = is_unknown ? "no command '" + app.remaining().front() + "'" : error.what();
    return refuse(what + "; see swiftlet --help");
  }
  if (doctor->parsed()) return run_doctor(doctor_command);
  swiftlet::Status status = swiftlet::Error{{}, "no command given; see swiftlet --help"};
  if (map->parsed()) status = swiftlet::run_map_command(map_command);
  if (sim->parsed()) status = swiftlet::run_sim_command(sim_command);
  if (record->parsed()) status = swiftlet::run_record_command(record_command);
  if (eval->parsed()) status = swiftlet::run_eval_command(eval_command);
  if (calibrate->parsed()) status = swiftlet::run_calibrate_command(calibrate_command);
  if (latency->parsed()) status = swiftlet::run_latency_command(latency_command);
  return status ? 0 : refuse(status.error().message);
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return run(argc, argv);
  } catch (const std::exception& error) {  // out of memory, or a fault of the standard library's
    return refuse(error.what());
  }
}
