// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
//
// A robot with wheels and a laser scanner, drawn at random, drives through the building of that seed
// (docs/simulated_buildings.md), whose walls are 8 to 30 cm thick. Writes its laser log and the true path of
// the laser, and prints the kind of building. For tools/benchmark-robustness.
#include <charconv>
#include <cstdio>
#include <exception>
#include <fstream>
#include <string>
#include <string_view>

#include "firmware_link/simulation/building_generator.hpp"
#include "tests/benchmarks/wheeled_robot.hpp"

namespace swiftlet {
namespace {

bool write(const std::string& file, const std::string& text) {
  return static_cast<bool>(std::ofstream(file) << text << std::flush);
}

int run(std::uint64_t seed, const std::string& prefix) {
  const SimulatedWorld building = draw_building(seed);
  const WheeledRobot robot = draw_robot(seed);
  NoiseSource driver(seed, "robot_driver");
  NoiseSource walls(seed, "robot_walls");
  NoiseSource wheels(seed, "robot_wheels");
  NoiseSource laser(seed, "robot_laser");
  const RobotLog log = log_drive(robot, drive(robot, building.flight, driver), building.walls,
                                 walls.uniform(0.08, 0.3), wheels, laser);
  if (!write(prefix + ".clf", log.flaser) || !write(prefix + ".tum", log.truth)) {
    std::fprintf(stderr, "robot_log: %s.clf and .tum: cannot be written\n", prefix.c_str());
    return 2;
  }
  std::printf("%s\n", std::string(building.kind).c_str());
  return 0;
}

int run(int argc, char** argv) {
  std::uint64_t seed = 0;
  const std::string_view text = argc == 3 ? argv[1] : "";
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), seed);
  if (text.empty() || error != std::errc{} || end != text.data() + text.size()) {
    std::fprintf(stderr,
                 "usage: robot_log SEED PREFIX, as in robot_log 7 out, which writes out.clf, out.tum\n");
    return 2;
  }
  return run(seed, argv[2]);
}

}  // namespace
}  // namespace swiftlet

int main(int argc, char** argv) {
  try {
    return swiftlet::run(argc, argv);
  } catch (const std::exception& error) {  // out of memory, or a fault of a library's
    std::fprintf(stderr, "robot_log: %s\n", error.what());
    return 2;
  }
}
