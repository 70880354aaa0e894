// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "tests/support/test_vehicle.hpp"
#include "tests/support/text_room.hpp"

namespace swiftlet {

/// A corridor of 2 m around a block of 9 m by 5 m, with nooks, so that every stretch of it looks different. A
/// lap from 'a' over 'b', 'c', 'd' is 38 m, counter-clockwise. `shift_m` moves the whole building.
inline TextRoom loop_corridor(const Point2& shift_m = {}) {
  constexpr double kBlockM = 0.5;
  static const std::vector<std::string> kPicture{"############################",  //
                                                 "#..........###.............#",  //
                                                 "#.d......................c.#",  //
                                                 "#..........................#",  //
                                                 "#.....#............##......#",  //
                                                 "#....##################....#",  //
                                                 "#....##################....#",  //
                                                 "##...##################....#",  //
                                                 "##...##################....#",  //
                                                 "#....#################.....#",  //
                                                 "#....#################....##",  //
                                                 "#....##################...##",  //
                                                 "#....##################....#",  //
                                                 "#...###################....#",  //
                                                 "#...###################....#",  //
                                                 "#.....########..#######....#",  //
                                                 "#...............########...#",  //
                                                 "#.a......................b.#",  //
                                                 "#........##................#",  //
                                                 "############################"};
  return {kPicture, kBlockM, shift_m};
}

/// A vehicle at 'a' that looks towards 'b'.
inline TestVehicle vehicle_at_start(const TestVehicleModel& model, std::uint32_t seed) {
  const TextRoom room = loop_corridor();
  return {room, Pose2(room.place('a').x_m, room.place('a').y_m, 0.0), model, seed};
}

/// Flies from place to place; the places keep their coordinates even if the building has moved.
inline void fly_along(TestVehicle& vehicle, const TextRoom& room, const std::string& places) {
  const TextRoom here = loop_corridor();
  for (const char place : places) vehicle.fly_to(room, here.place(place));
}

}  // namespace swiftlet
