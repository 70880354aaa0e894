// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <utility>
#include <vector>

#include "daemon/config/configuration.hpp"
#include "daemon/workers/pipeline.hpp"
#include "firmware_link/simulation/steered_flight.hpp"
#include "tests/support/scripted_sample_source.hpp"
#include "tests/support/shared_flight.hpp"

// A client flies the simulated vehicle by setpoints over a shared radio, while the map is made.

namespace swiftlet {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

constexpr Duration kGroundTime = seconds(10);
constexpr Duration kFlightTime = seconds(200);
constexpr Duration kSetpointPeriod = milliseconds(10);

VehicleModel steered_vehicle() {
  VehicleModel model = vehicle_on_radio();
  model.is_steered = true;
  return model;
}

/// Keeps a vehicle on the world's script, as one who sees it.
class Pilot {
 public:
  explicit Pilot(SimulatedVehicle& vehicle) : vehicle_(vehicle), script_(vehicle.world(), {}, /*seed=*/1) {}

  /// To be called each kSetpointPeriod.
  [[nodiscard]] HoverSetpoint next() {
    script_.step();
    const FlightState& aim = script_.state();
    const Pose2 T_world_body = vehicle_.T_world_body(vehicle_.now());
    const Pose2 T_body_aim = between(T_world_body, aim.T_world_body);
    const double c = std::cos(T_body_aim.yaw_rad());
    const double s = std::sin(T_body_aim.yaw_rad());
    return {.vx_body_m_s = c * aim.vx_body_m_s - s * aim.vy_body_m_s + T_body_aim.x_m(),
            .vy_body_m_s = s * aim.vx_body_m_s + c * aim.vy_body_m_s + T_body_aim.y_m(),
            .yaw_rate_rad_s = aim.yaw_rate_rad_s + 2.0 * T_body_aim.yaw_rad(),
            .height_m = aim.height_m};
  }
  [[nodiscard]] double off_course_m() const {
    return distance_m(vehicle_.T_world_body(vehicle_.now()).position(),
                      script_.state().T_world_body.position());
  }

 private:
  SimulatedVehicle& vehicle_;
  SimulatedFlight script_;
};

/// All that a replay needs, in memory.
class FrameKeeper final : public FrameSink {
 public:
  void take(const LinkFrame& frame) noexcept override { frames.push_back(frame); }
  std::vector<LinkFrame> frames;
};

class KeptFrames final : public Link {
 public:
  explicit KeptFrames(const std::vector<LinkFrame>& frames) : frames_(frames) {}
  Result<LinkFrame> receive(Duration /*timeout*/) override {
    if (next_ == frames_.size()) return Error{ErrorCode::kEndOfRecording, "end"};
    LinkFrame frame = frames_[next_++];
    frame.is_ours = true;  // a recording does not say
    return frame;
  }
  Status send(std::span<const std::uint8_t> /*packet*/) override { return {}; }

 private:
  const std::vector<LinkFrame>& frames_;
  std::size_t next_ = 0;
};

struct Mapped {
  std::vector<RangeSample> samples;
  std::vector<Pose2> T_map_body;
  std::map<std::pair<int, int>, int> cells;  ///< known ones, by column and row: percent occupied
  double off_course_m = 0.0;
  std::vector<LinkFrame> frames;
};

void make_map(Mapped& mapped) {
  ScriptedSampleSource source(mapped.samples);
  Pipeline pipeline(Configuration{}, source);
  for (bool more = true; more;) {
    const Result<bool> step = pipeline.step();
    ASSERT_TRUE(step.ok());
    more = *step;
  }
  for (const auto& [id, scan] : pipeline.backend().scans().all())
    mapped.T_map_body.push_back(pipeline.backend().T_map_body(id));
  for (const TileIndex index : pipeline.map().tiles()) {
    const MapTile tile = pipeline.map().tile(index);
    for (int i = 0; i < static_cast<int>(tile.occupancy_percent.size()); ++i)
      if (tile.occupancy_percent[static_cast<std::size_t>(i)] >= 0)
        mapped.cells[{index.x * kTileCells + i % kTileCells, index.y * kTileCells + i / kTileCells}] =
            tile.occupancy_percent[static_cast<std::size_t>(i)];
  }
}

/// `through_link`: the setpoints come from a client of the shared link; else they reach the vehicle by
/// themselves, and the link is swiftlet's alone.
Mapped fly(bool through_link) {
  FrameKeeper recording;
  SharedFlight shared(1, steered_vehicle(), &recording);
  Pilot pilot(shared.flight.vehicle);
  shared.fly(kGroundTime);
  Mapped mapped;
  FlightClient* client = nullptr;
  if (through_link) {
    client = &shared.add_client();
    client->connect();
    const std::array<std::uint16_t, 3> variables{0, 1, 2};
    client->start_block(1, variables, 2);
  }
  shared.every(kSetpointPeriod, [&] {
    const CrtpPacket setpoint = hover_packet(pilot.next());
    if (client != nullptr)
      client->send(setpoint);
    else
      static_cast<void>(shared.flight.vehicle.handle(bytes_of(setpoint)));
    mapped.off_course_m = std::max(mapped.off_course_m, pilot.off_course_m());
  });
  shared.fly(kFlightTime);
  if (client != nullptr) {
    EXPECT_TRUE(client->is_idle());
    EXPECT_EQ(client->unanswered(), 0U);
    EXPECT_GT(client->data().at(1).size(), 9000U);
  }
  EXPECT_EQ(shared.source->report().counters.gaps, 0U);
  mapped.samples = std::move(shared.samples);
  mapped.frames = std::move(recording.frames);
  make_map(mapped);
  return mapped;
}

class SharedFlightTest : public testing::Test {
 protected:
  static const Mapped& shared() {
    static const Mapped kFlight = fly(true);
    return kFlight;
  }
  static const Mapped& alone() {
    static const Mapped kFlight = fly(false);
    return kFlight;
  }
};

constexpr int kOccupied = 65;  // percent

/// Of the occupied cells of one map: those with an occupied one of the other beside them.
double share_found(const Mapped& of, const Mapped& in) {
  int occupied = 0;
  int found = 0;
  for (const auto& [cell, percent] : of.cells) {
    if (percent < kOccupied) continue;
    ++occupied;
    bool is_found = false;
    for (int dx = -1; dx <= 1; ++dx)
      for (int dy = -1; dy <= 1; ++dy) {
        const auto other = in.cells.find({cell.first + dx, cell.second + dy});
        is_found = is_found || (other != in.cells.end() && other->second >= kOccupied);
      }
    found += is_found ? 1 : 0;
  }
  EXPECT_GT(occupied, 500);
  return static_cast<double>(found) / std::max(1, occupied);
}

TEST_F(SharedFlightTest, AFlightBySetpointsKeepsItsCourse) {
  EXPECT_LT(shared().off_course_m, 0.3);
  EXPECT_LT(alone().off_course_m, 0.3);
}

TEST_F(SharedFlightTest, TheMapIsThatOfTheSameFlightUnshared) {
  ASSERT_EQ(shared().samples.size(), alone().samples.size());
  ASSERT_EQ(shared().T_map_body.size(), alone().T_map_body.size());
  double farthest_m = 0.0;
  for (std::size_t i = 0; i < shared().T_map_body.size(); ++i) {
    const Pose2 apart = between(shared().T_map_body[i], alone().T_map_body[i]);
    farthest_m = std::max(farthest_m, std::hypot(apart.x_m(), apart.y_m()));
  }
  const double found_of_shared = share_found(shared(), alone());
  const double found_of_alone = share_found(alone(), shared());
  RecordProperty("farthest_mm", static_cast<int>(1000.0 * farthest_m));
  RecordProperty("found_per_mille", static_cast<int>(1000.0 * std::min(found_of_shared, found_of_alone)));
  EXPECT_LT(farthest_m, 0.1);
  EXPECT_GT(found_of_shared, 0.95);
  EXPECT_GT(found_of_alone, 0.95);
}

TEST_F(SharedFlightTest, TheRecordingReplaysToTheSameSamples) {
  LinkInput input;
  input.name = "recording";
  input.link = std::make_unique<KeptFrames>(shared().frames);
  LinkSampleSource replay(std::move(input));
  std::size_t count = 0;
  Result<ReceivedSample> next = replay.next();
  for (; next || next.error().code == ErrorCode::kTimeout; next = replay.next()) {
    if (!next) continue;
    ASSERT_LT(count, shared().samples.size());
    const RangeSample& lived = shared().samples[count];
    EXPECT_EQ(next->sample.stamp, lived.stamp);
    EXPECT_EQ(next->sample.measured_at, lived.measured_at);
    EXPECT_EQ(next->sample.T_odom_body.x_m(), lived.T_odom_body.x_m());
    EXPECT_EQ(next->sample.T_odom_body.yaw_rad(), lived.T_odom_body.yaw_rad());
    EXPECT_EQ(next->sample.distance_m, lived.distance_m);
    EXPECT_EQ(next->sample.starts_segment, lived.starts_segment);
    ++count;
  }
  EXPECT_GE(count + 1, shared().samples.size());
  EXPECT_LE(count, shared().samples.size() + 1);
}

}  // namespace
}  // namespace swiftlet
