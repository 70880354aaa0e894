// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors

// The swiftlet command line. Exit code 0: done; 2: bad input of any kind, said in one line on stderr.

#include <CLI/CLI.hpp>
#include <cstdio>
#include <exception>
#include <string>

#include "core/sensing/range_sample.hpp"
#include "tools/map_command.hpp"

namespace {

constexpr int kExitBadInput = 2;

int refuse(std::string message) {
  for (char& c : message)
    if (c == '\n') c = ' ';
  std::fprintf(stderr, "swiftlet: %s\n", message.c_str());
  return kExitBadInput;
}

CLI::App* add_map_command(CLI::App& app, swiftlet::MapCommand& command) {
  CLI::App* map =
      app.add_subcommand("map", "Take a whole input through the pipeline and write map and trajectory");
  map->add_option(
         "INPUT", command.input,
         "replay:FILE.pcap, sim://WORLD?seed=N (office, maze, loop, corridors), or a path: .pcap, .clf, "
         ".clf.gz")
      ->required();
  map->add_option("-o,--output", command.output_directory, "Directory for the outputs, created where missing")
      ->required();
  map->add_option("--config", command.config_file, "TOML file with settings");
  map->add_option("--beams", command.beams, "Laser logs: how many beams to keep")
      ->check(CLI::Range(2, static_cast<int>(swiftlet::kMaxBeams)));
  CLI::Option* odometry =
      map->add_flag("--odometry-only", command.odometry_only, "Correct nothing: a baseline");
  map->add_flag("--frontend-only", command.frontend_only, "Walls but no loop closures: a baseline")
      ->excludes(odometry);
  return map;
}

int run(int argc, char** argv) {
  CLI::App app("2D SLAM for four range beams");
  app.name("swiftlet");
  app.set_version_flag("--version", SWIFTLET_VERSION);
  app.require_subcommand(1);
  swiftlet::MapCommand map_command;
  const CLI::App* map = add_map_command(app, map_command);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) return app.exit(error);  // --help, --version
    return refuse(std::string(error.what()) + "; see swiftlet --help");
  }
  if (!map->parsed()) return refuse("no command given; see swiftlet --help");
  const swiftlet::Status status = swiftlet::run_map_command(map_command);
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
