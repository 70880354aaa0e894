// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include <algorithm>
#include <array>
#include <initializer_list>
#include <optional>
#include <span>
#include <string>

#include "firmware_link/simulation/building_generator.hpp"
#include "firmware_link/simulation/world.hpp"

// The worlds of world.hpp, a row each in the table at the end. Coordinates are metres, x to the right, y up
// the page. Corridors are about 2 m wide and doors 0.9 m, as in the buildings where the vehicle flies, so
// that its 2 to 3 m of useful range meet walls. Cupboards and pillars keep one corridor from looking exactly
// like the next.
namespace swiftlet {
namespace {

constexpr double kDoorWidth = 0.9;
constexpr double kHouseDoorWidth = 1.0;

/// Collects the walls of a plan.
class FloorPlan {
 public:
  explicit FloorPlan(double door_width = kDoorWidth) : half_door_(door_width / 2.0) {}

  /// A wall along x, with doors centred at `doors_x` (ascending).
  void wall_x(double y, double x0, double x1, std::initializer_list<double> doors_x = {}) {
    for (const double door : doors_x) {
      walls_.push_back({{x0, y}, {door - half_door_, y}});
      x0 = door + half_door_;
    }
    walls_.push_back({{x0, y}, {x1, y}});
  }
  void wall_y(double x, double y0, double y1, std::initializer_list<double> doors_y = {}) {
    for (const double door : doors_y) {
      walls_.push_back({{x, y0}, {x, door - half_door_}});
      y0 = door + half_door_;
    }
    walls_.push_back({{x, y0}, {x, y1}});
  }
  /// Four walls: a block of the building, a cupboard, a pillar.
  void box(double x0, double y0, double x1, double y1) {
    wall_x(y0, x0, x1);
    wall_x(y1, x0, x1);
    wall_y(x0, y0, y1);
    wall_y(x1, y0, y1);
  }
  [[nodiscard]] std::vector<WallSegment> take() { return std::move(walls_); }

 private:
  double half_door_;
  std::vector<WallSegment> walls_;
};

constexpr PilotHeading kKeep = PilotHeading::kKeep;
constexpr PilotHeading kTravel = PilotHeading::kIntoTravel;

/// 20 m x 15 m: a corridor ring with a passage across its middle, seven rooms outside the ring, one inside
/// and one locked.
std::vector<WallSegment> office_walls() {
  FloorPlan plan;
  plan.box(0.0, 0.0, 20.0, 15.0);
  plan.wall_x(4.0, 0.0, 20.0, {2.5, 7.6, 13.0, 17.4});
  plan.wall_x(11.0, 0.0, 20.0, {3.2, 9.8, 16.6});
  for (const double x : {5.0, 10.5, 15.5}) plan.wall_y(x, 0.0, 4.0);
  for (const double x : {6.5, 13.0}) plan.wall_y(x, 11.0, 15.0);
  // The inner block: a room to the left of the passage, the locked one to its right.
  plan.wall_x(6.0, 2.0, 9.2);
  plan.wall_x(9.0, 2.0, 9.2, {5.5});
  plan.wall_y(2.0, 6.0, 9.0);
  plan.wall_y(9.2, 6.0, 9.0);
  plan.box(11.0, 6.0, 18.0, 9.0);
  // Cupboards and pillars in the corridors.
  plan.box(0.0, 7.0, 0.4, 8.4);
  plan.box(13.5, 10.6, 14.7, 11.0);
  plan.box(5.4, 4.0, 6.6, 4.35);
  plan.box(15.0, 5.7, 15.3, 6.0);
  plan.box(19.6, 8.2, 20.0, 8.8);
  plan.box(7.2, 9.0, 7.5, 9.3);
  // Furniture in the rooms.
  plan.box(0.0, 0.0, 0.6, 2.2);
  plan.box(9.9, 0.8, 10.5, 2.6);
  plan.box(12.0, 0.0, 14.0, 0.5);
  plan.box(19.4, 1.0, 20.0, 3.0);
  plan.box(0.0, 14.4, 2.5, 15.0);
  plan.box(11.2, 13.2, 11.6, 13.6);
  plan.box(19.5, 12.0, 20.0, 14.0);
  plan.box(2.0, 6.0, 2.5, 6.8);
  return plan.take();
}

/// Round the ring to the left with a look into four rooms; on to the left through its right half and the
/// passage, then to the right round its left half, with a look into the other four; once round the ring to
/// the right.
std::vector<Waypoint> office_flight() {
  return {{{10.1, 5.0}},       {{13.0, 5.0}},       {{13.0, 1.8}, kTravel, 2.0 * kPi},
          {{13.0, 5.0}},       {{19.0, 5.0}},       {{19.0, 10.0}},
          {{16.6, 10.0}},      {{16.6, 12.8}},      {{14.8, 13.0}},
          {{16.6, 12.8}},      {{16.6, 10.0}},      {{5.5, 10.0}},
          {{5.5, 7.5}},        {{4.0, 7.5}},        {{7.2, 7.5}, kKeep},
          {{5.5, 7.5}},        {{5.5, 10.0}},       {{1.0, 10.0}},
          {{1.0, 5.0}},        {{2.5, 5.0}},        {{2.5, 2.0}},
          {{2.5, 5.0}, kKeep}, {{17.4, 5.0}},       {{17.4, 2.0}, kTravel, -2.0 * kPi},
          {{17.4, 5.0}},       {{19.0, 5.0}},       {{19.0, 10.0}},
          {{10.1, 10.0}},      {{10.1, 5.0}},       {{7.6, 5.0}},
          {{7.6, 2.2}},        {{7.6, 5.0}, kKeep}, {{1.0, 5.0}},
          {{1.0, 10.0}},       {{3.2, 10.0}},       {{3.2, 12.8}, kTravel, kPi},
          {{3.2, 10.0}},       {{9.8, 10.0}},       {{9.8, 12.5}},
          {{9.8, 10.0}},       {{10.1, 8.0}},       {{10.1, 5.0}},
          {{1.0, 5.0}},        {{1.0, 10.0}},       {{19.0, 10.0}},
          {{19.0, 5.0}},       {{10.1, 5.0}}};
}

/// One corridor around a block, 25 m x 15 m.
std::vector<WallSegment> loop_walls() {
  FloorPlan plan;
  plan.box(0.0, 0.0, 25.0, 15.0);
  plan.box(2.0, 2.0, 23.0, 13.0);
  for (const double x : {5.0, 9.5, 16.0, 20.0}) plan.box(x, 0.0, x + 0.5, 0.3);
  for (const double x : {7.0, 18.5}) plan.box(x, 1.7, x + 0.3, 2.0);
  for (const double y : {4.0, 8.5}) plan.box(24.7, y, 25.0, y + 0.8);
  plan.box(22.7, 6.0, 23.0, 6.3);
  for (const double x : {4.0, 12.0, 17.5}) plan.box(x, 14.6, x + 1.0, 15.0);
  for (const double x : {8.0, 20.5}) plan.box(x, 13.0, x + 0.4, 13.3);
  plan.box(0.0, 9.0, 0.4, 10.2);
  for (const double y : {4.5, 11.0}) plan.box(2.0, y, 1.7, y + 0.3);
  return plan.take();
}

/// Round to the left and a little further, a look around, then all the way round to the right.
std::vector<Waypoint> loop_flight() {
  return {{{3.0, 1.0}},  {{24.0, 1.0}}, {{24.0, 14.0}},
          {{1.0, 14.0}}, {{1.0, 1.0}},  {{11.0, 1.0}, kTravel, 2.0 * kPi},
          {{1.0, 1.0}},  {{1.0, 14.0}}, {{24.0, 14.0}},
          {{24.0, 1.0}}, {{3.0, 1.0}}};
}

/// 24 m x 14 m: three corridors along x and three along y, which cross at right angles.
std::vector<WallSegment> corridors_walls() {
  FloorPlan plan;
  plan.box(0.0, 0.0, 24.0, 14.0);
  plan.box(2.0, 2.0, 8.0, 5.0);
  plan.box(10.0, 2.0, 22.0, 5.0);
  plan.box(2.0, 7.0, 8.0, 12.0);
  plan.box(10.0, 7.0, 22.0, 12.0);
  for (const double x : {4.0, 12.5, 17.0}) plan.box(x, 0.0, x + 0.6, 0.3);
  for (const double x : {5.5, 15.0}) plan.box(x, 5.0, x + 0.3, 5.3);
  for (const double x : {13.0, 19.0}) plan.box(x, 6.7, x + 0.5, 7.0);
  for (const double x : {6.0, 11.0, 20.0}) plan.box(x, 13.6, x + 0.8, 14.0);
  plan.box(16.0, 12.0, 16.3, 12.3);
  plan.box(0.0, 3.0, 0.3, 3.6);
  plan.box(0.0, 9.0, 0.4, 10.0);
  plan.box(9.7, 9.0, 10.0, 9.6);
  plan.box(23.6, 3.0, 24.0, 4.0);
  plan.box(23.7, 8.5, 24.0, 9.0);
  return plan.take();
}

std::vector<Waypoint> corridors_flight() {
  return {{{9.0, 6.0}},   {{23.0, 6.0}}, {{23.0, 1.0}},       {{9.0, 1.0}},
          {{9.0, 6.0}},   {{1.0, 6.0}},  {{1.0, 13.0}},       {{9.0, 13.0}},
          {{9.0, 1.0}},   {{1.0, 1.0}},  {{1.0, 6.0}},        {{23.0, 6.0}, kTravel, kPi},
          {{23.0, 13.0}}, {{1.0, 13.0}}, {{1.0, 6.0}},        {{9.0, 6.0}},
          {{9.0, 1.0}},   {{15.0, 1.0}}, {{9.0, 1.0}, kKeep}, {{9.0, 6.0}}};
}

constexpr double kSlantFromX = 12.0;
constexpr double kSlant = 0.364;  // tan 20 degrees

/// Points to the right of the slant's beginning move up the page, in proportion to their distance.
Point2 slanted(const Point2& p) { return {p.x_m, p.y_m + kSlant * std::max(0.0, p.x_m - kSlantFromX)}; }

/// The point where a line crosses the beginning of the slant and bends; nullopt if it does not.
std::optional<Point2> bend_between(const Point2& a, const Point2& b) {
  if ((a.x_m - kSlantFromX) * (b.x_m - kSlantFromX) >= 0.0) return std::nullopt;
  const double share = (kSlantFromX - a.x_m) / (b.x_m - a.x_m);
  return Point2{kSlantFromX, a.y_m + share * (b.y_m - a.y_m)};
}

/// The corridors, but those of the right half run 20 degrees askew: a building whose walls share no one axis.
std::vector<WallSegment> wings_walls() {
  std::vector<WallSegment> walls;
  for (const WallSegment& wall : corridors_walls()) {
    const std::optional<Point2> bend = bend_between(wall.start, wall.end);
    walls.push_back({slanted(wall.start), bend ? *bend : slanted(wall.end)});
    if (bend) walls.push_back({*bend, slanted(wall.end)});
  }
  return walls;
}

std::vector<Waypoint> wings_flight() {
  std::vector<Waypoint> flight;
  Point2 from = corridors_flight().front().position;
  for (Waypoint waypoint : corridors_flight()) {
    if (const std::optional<Point2> bend = bend_between(from, waypoint.position))
      flight.push_back({*bend, waypoint.heading});
    from = waypoint.position;
    waypoint.position = slanted(waypoint.position);
    flight.push_back(waypoint);
  }
  return flight;
}

constexpr double kMazeCell = 2.0;
/// Rows alternate between the walls above a row of cells and the cells themselves.
constexpr std::array<std::string_view, 11> kMaze{"+--+--+--+--+--+--+--+",  //
                                                 "|           |        |",  //
                                                 "+  +  +--+  +  +--+  +",  //
                                                 "|  |           |  |  |",  //
                                                 "+  +  +--+--+--+  +  +",  //
                                                 "|                    |",  //
                                                 "+  +--+--+  +--+--+  +",  //
                                                 "|  |     |           |",  //
                                                 "+--+  +  +  +--+--+  +",  //
                                                 "|     |     |        |",  //
                                                 "+--+--+--+--+--+--+--+"};
/// The flight as moves from cell to cell, from the lower left corner through the whole maze and back, most of
/// it in both directions, and a piece of the way again.
constexpr std::string_view kMazeMoves =
    "ENESENNEENSENNWWSWNWWSEEWWSEEWWWNNEWSSSNENNEESENEESSSSWWEENNWWWSSWNWSWENESENNEE";

/// The waypoint that a step from `at` leads to.
Point2 maze_step(const Point2& at, char move) {
  switch (move) {
    case 'E':
      return {at.x_m + kMazeCell, at.y_m};
    case 'W':
      return {at.x_m - kMazeCell, at.y_m};
    case 'N':
      return {at.x_m, at.y_m + kMazeCell};
    default:
      return {at.x_m, at.y_m - kMazeCell};
  }
}

std::vector<WallSegment> maze_walls() {
  FloorPlan plan;
  constexpr std::size_t kRowsOfCells = kMaze.size() / 2;
  double y_m = kMazeCell * static_cast<double>(kRowsOfCells);  // of the line, downwards
  for (const std::string_view line : kMaze) {
    double x_m = 0.0;
    for (std::size_t column = 0; column < line.size(); column += 3, x_m += kMazeCell) {
      if (line[column] == '|') plan.wall_y(x_m, y_m - kMazeCell / 2.0, y_m + kMazeCell / 2.0);
      if (line.substr(column).starts_with("+-")) plan.wall_x(y_m, x_m, x_m + kMazeCell);
    }
    y_m -= kMazeCell / 2.0;
  }
  return plan.take();
}

std::vector<Waypoint> maze_flight() {
  std::vector<Waypoint> flight{{{kMazeCell / 2.0, kMazeCell / 2.0}}};
  for (std::size_t i = 0; i < kMazeMoves.size(); ++i) {
    const Point2 next = maze_step(flight.back().position, kMazeMoves[i]);
    const bool goes_straight_on = i > 0 && kMazeMoves[i] == kMazeMoves[i - 1];
    if (goes_straight_on) {
      flight.back().position = next;
    } else {
      flight.push_back({next});
    }
  }
  return flight;
}

/// One room of 8 m x 6 m with a table and a pillar in its middle and furniture along its walls.
std::vector<WallSegment> patrol_walls() {
  FloorPlan plan;
  plan.box(0.0, 0.0, 8.0, 6.0);
  plan.box(4.4, 2.6, 5.6, 3.4);
  plan.box(2.7, 2.9, 3.0, 3.2);
  plan.box(0.0, 2.2, 0.6, 3.6);
  plan.box(2.8, 0.0, 4.6, 0.4);
  plan.box(7.6, 0.0, 8.0, 0.4);
  plan.box(7.5, 2.4, 8.0, 3.4);
  plan.box(5.0, 5.5, 6.2, 6.0);
  plan.box(1.4, 5.6, 2.6, 6.0);
  return plan.take();
}

/// Round the room to the left, with a look around in one corner: for long flights of many laps.
std::vector<Waypoint> patrol_flight() {
  return {{{1.2, 1.2}}, {{6.8, 1.2}}, {{6.8, 4.8}, kTravel, 2.0 * kPi}, {{1.2, 4.8}}, {{1.2, 1.2}}};
}

/// What the floors of the house share: the outer walls, 16 m x 12 m, and along one of them the stairwell,
/// whose door is centred at `stair_door_x`.
FloorPlan house_shell(double stair_door_x) {
  FloorPlan plan(kHouseDoorWidth);
  plan.box(0.0, 0.0, 16.0, 12.0);
  plan.wall_y(4.4, 10.6, 12.0);
  plan.wall_y(11.8, 10.6, 12.0);
  plan.wall_x(10.6, 4.4, 11.8, {stair_door_x});
  return plan;
}

/// Three rooms on either side of a corridor, the middle one of those above it in front of the stairs.
std::vector<WallSegment> house_lower_walls() {
  FloorPlan plan = house_shell(5.0);
  plan.wall_x(5.2, 0.0, 16.0, {2.8, 8.2, 13.4});
  plan.wall_x(7.0, 0.0, 16.0, {2.2, 8.0, 14.0});
  plan.wall_y(5.5, 0.0, 5.2, {2.0});
  plan.wall_y(10.8, 0.0, 5.2, {3.0});
  plan.wall_y(4.4, 7.0, 10.6, {8.6});
  plan.wall_y(11.8, 7.0, 10.6, {9.2});
  // Furniture.
  plan.box(6.2, 0.0, 7.6, 0.5);
  plan.box(15.4, 0.6, 16.0, 2.4);
  plan.box(0.0, 0.4, 0.6, 1.8);
  plan.box(0.0, 11.4, 1.8, 12.0);
  plan.box(15.5, 10.0, 16.0, 11.4);
  plan.box(10.2, 7.0, 11.4, 7.4);
  plan.box(0.0, 5.6, 0.4, 6.6);
  plan.box(11.0, 6.7, 11.6, 7.0);
  return plan.take();
}

/// Five rooms, whose walls stand 0.6 to 1.8 m beside those below.
std::vector<WallSegment> house_upper_walls() {
  FloorPlan plan = house_shell(11.2);
  plan.wall_x(4.4, 0.0, 16.0, {2.0, 7.0, 12.5});
  plan.wall_x(6.4, 0.0, 16.0, {3.5, 9.5, 14.5});
  plan.wall_y(4.2, 0.0, 4.4, {2.2});
  plan.wall_y(6.2, 6.4, 10.6, {8.0});
  plan.wall_y(13.0, 6.4, 12.0, {9.0});
  // Furniture.
  plan.box(0.0, 0.0, 1.6, 0.6);
  plan.box(8.2, 0.0, 9.2, 0.5);
  plan.box(15.2, 0.0, 16.0, 1.8);
  plan.box(0.0, 9.2, 0.6, 11.2);
  plan.box(7.2, 10.0, 9.0, 10.6);
  plan.box(15.4, 11.0, 16.0, 12.0);
  plan.box(5.0, 6.1, 5.8, 6.4);
  return plan.take();
}

constexpr Point2 kHouseLoopBelow[] = {{6.5, 6.1},  {8.2, 6.1},  {8.2, 3.0}, {13.4, 3.0}, {13.4, 6.1},
                                      {14.0, 6.1}, {14.0, 9.2}, {9.0, 9.2}, {9.0, 8.6},  {2.2, 8.6},
                                      {2.2, 6.1},  {2.8, 6.1},  {2.8, 2.0}, {8.2, 2.0},  {8.2, 6.1},
                                      {8.0, 6.1},  {8.0, 8.6},  {5.0, 8.6}, {5.0, 11.3}, {5.6, 11.3}};
constexpr Point2 kHouseLoopAbove[] = {{10.6, 11.3}, {11.2, 11.3}, {11.2, 9.0},  {14.5, 9.0}, {14.5, 5.4},
                                      {12.5, 5.4},  {12.5, 2.2},  {2.0, 2.2},   {2.0, 5.4},  {3.5, 5.4},
                                      {3.5, 8.0},   {11.2, 8.0},  {11.2, 11.3}, {10.6, 11.3}};
constexpr Point2 kHouseAgainBelow[] = {
    {5.6, 11.3}, {5.0, 11.3}, {5.0, 8.6},  {8.0, 8.6}, {8.0, 6.1}, {8.2, 6.1}, {8.2, 3.0}, {13.4, 3.0},
    {13.4, 6.1}, {14.0, 6.1}, {14.0, 9.2}, {9.0, 9.2}, {9.0, 8.6}, {8.0, 8.6}, {8.0, 6.1}, {6.5, 6.1}};

/// Through all rooms below, up the stairs, round above, down, and once more through half of the rooms below.
std::vector<Waypoint> house_flight() {
  std::vector<Waypoint> flight;
  const auto add = [&flight](std::span<const Point2> way, int storey) {
    for (const Point2& position : way) flight.push_back({.position = position, .storey = storey});
  };
  add(kHouseLoopBelow, 0);
  add(kHouseLoopAbove, 1);
  add(kHouseAgainBelow, 0);
  return flight;
}

SimulatedWorld house(std::uint64_t /*seed*/) {
  return {.walls = house_lower_walls(), .flight = house_flight(), .upper_walls = {house_upper_walls()}};
}

template <std::vector<WallSegment> (*kWalls)(), std::vector<Waypoint> (*kFlight)()>
SimulatedWorld by_hand(std::uint64_t /*seed*/) {
  return {kWalls(), kFlight()};
}

constexpr std::array kWorlds{
    WorldPlan{"office", "20 m x 15 m, a corridor ring with rooms on both sides",
              by_hand<office_walls, office_flight>},
    WorldPlan{"maze", "14 m x 10 m of cells of 2 m", by_hand<maze_walls, maze_flight>},
    WorldPlan{"loop", "25 m x 15 m, one corridor around a block", by_hand<loop_walls, loop_flight>},
    WorldPlan{"corridors", "24 m x 14 m, three corridors across three",
              by_hand<corridors_walls, corridors_flight>},
    WorldPlan{"wings", "the corridors, those of one half 20 degrees askew",
              by_hand<wings_walls, wings_flight>},
    WorldPlan{"patrol", "one room of 8 m x 6 m, flown round in 46 s", by_hand<patrol_walls, patrol_flight>},
    WorldPlan{"storeys", "two floors of a house of 16 m x 12 m, joined by stairs", house},
    WorldPlan{"building", "drawn at random, like the flight and the sensors' errors: another for each seed",
              draw_building},
};

}  // namespace

std::span<const WorldPlan> simulated_worlds() { return kWorlds; }

std::string simulated_world_names() {
  std::string names(kWorlds.front().name);
  for (const WorldPlan& world : simulated_worlds().subspan(1)) names.append(", ").append(world.name);
  return names;
}

Result<SimulatedWorld> make_simulated_world(std::string_view name, std::uint64_t seed) {
  for (const WorldPlan& world : kWorlds)
    if (world.name == name) return world.make(seed);
  return Error{ErrorCode::kNotFound, "no simulated world is called \"" + std::string(name) +
                                         "\"; choose one of: " + simulated_world_names()};
}

}  // namespace swiftlet
