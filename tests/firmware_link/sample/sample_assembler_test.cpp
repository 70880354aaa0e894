// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "firmware_link/sample/sample_assembler.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <map>
#include <vector>

#include "tests/firmware_link/frames.hpp"

namespace swiftlet {
namespace {

using std::chrono::milliseconds;

AssemblyConfig config() {
  AssemblyConfig config;
  config.beams = BeamLayout::multiranger();
  config.sensor = SensorModel::crazyflie();
  config.range_period = milliseconds(100);
  config.continuity.longest_interpolation = milliseconds(150);
  config.continuity.longest_silence = std::chrono::seconds(1);
  return config;
}

/// Feeds position as stream 1, yaw and ranges as stream 2, as the reference flights do.
class SampleAssemblerTest : public testing::Test {
 protected:
  void position(std::int64_t ms, double x_m, double y_m = 0.0) {
    Reading reading;
    reading.stream = 1;
    reading.at = device_ms(ms);
    reading.position_odom = Point2{x_m, y_m};
    feed(reading);
  }
  void ranges(std::int64_t ms, double yaw_rad = 0.0,
              const std::vector<float>& distances = {1.F, 1.F, 1.F, 1.F}, std::uint8_t stream = 2) {
    Reading reading;
    reading.stream = stream;
    reading.at = device_ms(ms);
    reading.received = host_ms(1'000'000 + ms);
    reading.yaw_odom_rad = yaw_rad;
    for (const float distance : distances) EXPECT_TRUE(reading.distance_m.try_push_back(distance));
    feed(reading);
  }
  void feed(const Reading& reading) {
    assembler_.add(reading);
    drain();
  }
  void drain() {
    while (const auto sample = assembler_.take()) samples_.push_back(*sample);
  }
  void end() {
    assembler_.end();
    drain();
  }

  InputCounters counters_;
  SampleAssembler assembler_{config(), counters_};
  std::vector<RangeSample> samples_;
};

TEST_F(SampleAssemblerTest, PairsRangesWithTheDeadReckoningOfTheTimeTheyWereMeasured) {
  position(0, 0.0);
  ranges(4, 0.0);
  position(100, 0.1);
  ranges(104, 0.2);
  position(200, 0.2);
  ranges(204, 0.4);
  end();
  ASSERT_EQ(samples_.size(), 2U);  // the first ranges are older than all dead reckoning
  EXPECT_EQ(samples_[0].measured_at, device_ms(4));
  EXPECT_EQ(samples_[0].stamp, host_ms(1'000'104));
  EXPECT_NEAR(samples_[0].T_odom_body.x_m(), 0.004, 1e-12);
  EXPECT_NEAR(samples_[0].T_odom_body.yaw_rad(), 0.0, 1e-12);
  EXPECT_NEAR(samples_[1].T_odom_body.x_m(), 0.104, 1e-12);
  EXPECT_NEAR(samples_[1].T_odom_body.yaw_rad(), 0.2, 1e-12);
  EXPECT_TRUE(samples_[0].starts_segment);
  EXPECT_FALSE(samples_[1].starts_segment);
  EXPECT_EQ(samples_[1].sequence, 1U);
  EXPECT_EQ(counters_.samples, 2U);
  EXPECT_EQ(counters_.unpaired, 1U);
  EXPECT_EQ(counters_.range_packets, 3U);
  EXPECT_EQ(counters_.odometry_packets, 6U);
  EXPECT_EQ(counters_.segments, 1U);
}

/// A packet with all that a sample needs, at 1 m/s.
Reading whole_reading(std::int64_t ms, const std::vector<float>& distances_m) {
  Reading reading;
  reading.at = device_ms(ms);
  reading.position_odom = Point2{1e-3 * static_cast<double>(ms), 0.0};
  reading.yaw_odom_rad = 0.0;
  for (const float distance_m : distances_m) EXPECT_TRUE(reading.distance_m.try_push_back(distance_m));
  return reading;
}

/// A log at 50 Hz of sensors that measure at 10 Hz.
TEST(SampleAssembler, MakesOneSampleOfEachMeasurementHoweverOftenItIsLogged) {
  AssemblyConfig fast = config();
  fast.range_period = milliseconds(20);
  fast.measurement_period = milliseconds(95);
  InputCounters counters;
  SampleAssembler assembler(fast, counters);
  std::vector<RangeSample> samples;
  for (std::int64_t ms = 0; ms <= 2000; ms += 20) {
    const std::int64_t measurement = ms / 100;
    const auto nothing_m = std::numeric_limits<float>::quiet_NaN();
    assembler.add(
        whole_reading(ms, {1.F + 0.01F * static_cast<float>(measurement), nothing_m, 2.F, 32.766F}));
    while (const auto sample = assembler.take()) samples.push_back(*sample);
  }
  ASSERT_EQ(samples.size(), 20U);  // the first is older than all dead reckoning
  for (std::size_t i = 1; i < samples.size(); ++i) {
    EXPECT_EQ(samples[i].measured_at - samples[i - 1].measured_at, milliseconds(100));
    EXPECT_NEAR(samples[i].distance_m[0] - samples[i - 1].distance_m[0], 0.01, 1e-5);
  }
  EXPECT_EQ(counters.range_packets, 101U);
  EXPECT_EQ(counters.repeated, 80U);
  EXPECT_EQ(counters.gaps, 0U);
}

TEST(SampleAssembler, TakesEqualDistancesAPeriodLaterForAMeasurement) {
  AssemblyConfig usual = config();
  usual.measurement_period = milliseconds(95);
  InputCounters counters;
  SampleAssembler assembler(usual, counters);
  for (std::int64_t ms = 0; ms <= 1000; ms += 98) assembler.add(whole_reading(ms, {1.F, 1.F, 1.F, 1.F}));
  EXPECT_EQ(counters.range_packets, 11U);
  EXPECT_EQ(counters.repeated, 0U);
}

TEST_F(SampleAssemblerTest, LevelsRangesByTheTiltOfTheMomentOfMeasurement) {
  const auto attitude = [this](std::int64_t ms, double x_up, double height_m) {
    Reading reading;
    reading.stream = 3;
    reading.at = device_ms(ms);
    reading.tilt = BodyTilt{.x_up = x_up, .y_up = 0.0};
    reading.height_m = height_m;
    feed(reading);
  };
  for (std::int64_t ms = 0; ms <= 600; ms += 100) {
    position(ms, 0.0);
    if (ms <= 300) attitude(ms, -1e-3 * static_cast<double>(ms), 0.5);  // then not logged any more
    ranges(ms + 50, 0.0, {1.F, 2.F, 2.F, 3.9F});
  }
  end();
  ASSERT_GE(samples_.size(), 5U);
  EXPECT_EQ(samples_[1].measured_at, device_ms(150));
  EXPECT_NEAR(samples_[1].distance_m[0], std::sqrt(1.0 - 0.15 * 0.15), 1e-6);
  EXPECT_NEAR(samples_[1].distance_m[2], 2.0 * std::sqrt(1.0 - 0.15 * 0.15), 1e-6) << "behind, it points up";
  EXPECT_EQ(samples_[1].distance_m[1], 2.F) << "the tilt is about its axis";
  EXPECT_EQ(counters_.floor_returns, 0U);
  EXPECT_EQ(samples_[4].distance_m[2], 2.F) << "unknown";
}

/// A live vehicle's packets of a second: pose, ranges and height each 100 ms, and roll and pitch in a packet
/// `lag_ms` behind, as long as `has_tilt` says so. How many packets later than its own each sample came, and
/// which samples were levelled.
struct LevelledFlight {
  std::vector<int> packets_waited;
  std::vector<bool> is_level;
};
template <typename HasTilt>
LevelledFlight fly_with_tilt(Duration range_age, std::int64_t lag_ms, HasTilt has_tilt) {
  AssemblyConfig aged = config();
  aged.sensor.range_age = range_age;
  InputCounters counters;
  SampleAssembler assembler(aged, counters);
  assembler.set_periods(milliseconds(100), milliseconds(100));
  LevelledFlight flight;
  int packets = 0;
  std::map<HostTime, int> packet_of;
  const auto drain = [&] {
    while (const auto sample = assembler.take()) {
      flight.packets_waited.push_back(packets - packet_of[sample->stamp]);
      flight.is_level.push_back(sample->distance_m[0] != 1.F);
    }
  };
  for (std::int64_t ms = 0; ms <= 1000; ms += 100) {
    Reading reading;
    reading.stream = 1;
    reading.at = device_ms(ms);
    reading.received = host_ms(ms);
    reading.position_odom = Point2();
    reading.yaw_odom_rad = 0.0;
    reading.height_m = 0.5;
    for (int beam = 0; beam < 4; ++beam) EXPECT_TRUE(reading.distance_m.try_push_back(1.F));
    packet_of[reading.received] = ++packets;
    assembler.add(reading);
    drain();
    if (!has_tilt(ms)) continue;
    Reading tilt;
    tilt.stream = 2;
    tilt.at = device_ms(ms + lag_ms);
    tilt.tilt = BodyTilt{.x_up = 0.2, .y_up = 0.0};
    ++packets;
    assembler.add(tilt);
    drain();
  }
  assembler.end();
  drain();
  return flight;
}

TEST(SampleAssembler, WaitsForTheTiltThatComesJustBehind) {
  for (const int age_ms : {60, 80, 95, 100}) {
    const LevelledFlight flight = fly_with_tilt(milliseconds(age_ms), 2, [](std::int64_t) { return true; });
    ASSERT_EQ(flight.is_level.size(), 10U) << age_ms;
    // The first has a tilt on one side only.
    EXPECT_EQ(std::count(flight.is_level.begin() + 1, flight.is_level.end(), true), 9) << age_ms;
    for (const int waited : flight.packets_waited) EXPECT_LE(waited, 1) << age_ms;
  }
}

TEST(SampleAssembler, TiltThatNeverCameStoppedOrComesSeldomIsNotWaitedFor) {
  const auto never = [](std::int64_t) { return false; };
  const auto stops = [](std::int64_t ms) { return ms < 400; };
  const auto seldom = [](std::int64_t ms) { return ms % 500 == 0; };
  for (const int waited : fly_with_tilt(milliseconds(60), 2, never).packets_waited) EXPECT_EQ(waited, 0);
  for (const int waited : fly_with_tilt(milliseconds(60), 2, seldom).packets_waited) EXPECT_EQ(waited, 0);
  const std::vector<int> waited = fly_with_tilt(milliseconds(60), 2, stops).packets_waited;
  ASSERT_EQ(waited.size(), 10U);
  for (std::size_t i = 6; i < waited.size(); ++i) EXPECT_EQ(waited[i], 0) << i;
}

TEST(SampleAssembler, TheLastSamplesDoNotNeedTheirTilt) {
  const LevelledFlight flight = fly_with_tilt(milliseconds(60), 2, [](std::int64_t ms) { return ms < 1000; });
  ASSERT_EQ(flight.is_level.size(), 10U);
  EXPECT_FALSE(flight.is_level.back());
}

Reading tilted_ranges(std::int64_t ms) {
  Reading reading;
  reading.stream = 2;
  reading.at = device_ms(ms);
  reading.tilt = BodyTilt{.x_up = 0.2, .y_up = 0.0};
  for (int beam = 0; beam < 4; ++beam) EXPECT_TRUE(reading.distance_m.try_push_back(1.F));
  return reading;
}

TEST(SampleAssembler, LevelsRangesWhoseTiltComesAsOftenThoughDeadReckoningComesMoreOften) {
  AssemblyConfig aged = config();
  aged.sensor.range_age = milliseconds(60);
  InputCounters counters;
  SampleAssembler assembler(aged, counters);
  assembler.set_periods(milliseconds(100), milliseconds(20));
  std::vector<RangeSample> samples;
  for (std::int64_t ms = 0; ms <= 1000; ms += 20) {
    assembler.add(whole_reading(ms, {}));
    if (ms % 100 == 0) assembler.add(tilted_ranges(ms));
    while (const auto sample = assembler.take()) samples.push_back(*sample);
  }
  ASSERT_EQ(samples.size(), 10U);  // the first is older than all dead reckoning
  for (const RangeSample& sample : samples)
    EXPECT_NEAR(sample.distance_m[0], std::sqrt(1.0 - 0.2 * 0.2), 1e-6);
}

/// By the time that the period of the ranges is known, that of dead reckoning has long been.
TEST(SampleAssembler, LevelsRangesThatComeSeldomByTheirPeriodAsItIsLearnt) {
  AssemblyConfig aged = config();
  aged.sensor.range_age = milliseconds(60);
  InputCounters counters;
  SampleAssembler assembler(aged, counters);
  assembler.set_periods(Duration::zero(), Duration::zero());
  std::vector<RangeSample> samples;
  for (std::int64_t ms = 0; ms <= 5000; ms += 100) {
    assembler.add(whole_reading(ms, {}));
    if (ms % 500 == 0) assembler.add(tilted_ranges(ms));
    while (const auto sample = assembler.take()) samples.push_back(*sample);
  }
  ASSERT_EQ(samples.size(), 10U);  // the first is older than all dead reckoning
  for (std::size_t i = 5; i < samples.size(); ++i)
    EXPECT_NEAR(samples[i].distance_m[0], std::sqrt(1.0 - 0.2 * 0.2), 1e-6) << i;
}

TEST_F(SampleAssemblerTest, TakesNoTiltThatIsNoneAndNoRangeOfABodyOnItsSide) {
  const auto attitude = [this](std::int64_t ms, const BodyTilt& tilt) {
    Reading reading;
    reading.stream = 3;
    reading.at = device_ms(ms);
    reading.tilt = tilt;
    feed(reading);
  };
  for (std::int64_t ms = 0; ms <= 300; ms += 100) {
    position(ms, 0.0);
    attitude(ms, ms < 200 ? BodyTilt{.x_up = 0.9, .y_up = 0.9} : BodyTilt{.x_up = 1.0, .y_up = 0.0});
    ranges(ms, 0.0);
  }
  end();
  ASSERT_EQ(samples_.size(), 3U);
  EXPECT_EQ(samples_[0].distance_m[0], 1.F) << "of no rotation: unknown";
  EXPECT_EQ(samples_[2].status[0], RangeStatus::kInvalid) << "it points up";
  EXPECT_EQ(samples_[2].distance_m[1], 1.F);
}

TEST_F(SampleAssemblerTest, LeavesOutWhatCanBeTheFloor) {
  for (std::int64_t ms = 0; ms <= 200; ms += 100) {
    position(ms, 0.0);
    Reading attitude;
    attitude.stream = 3;
    attitude.at = device_ms(ms);
    attitude.tilt = BodyTilt{.x_up = -0.2, .y_up = 0.0};
    attitude.height_m = 0.5;
    feed(attitude);
    ranges(ms + 4, 0.0, {2.5F, 2.5F, 2.5F, 2.5F});
  }
  end();
  ASSERT_GE(samples_.size(), 1U);
  EXPECT_EQ(samples_[0].status[0], RangeStatus::kInvalid);
  EXPECT_EQ(samples_[0].distance_m[0], 0.F);
  EXPECT_EQ(samples_[0].status[1], RangeStatus::kHit);
  EXPECT_EQ(samples_[0].status[2], RangeStatus::kHit);
  EXPECT_EQ(counters_.floor_returns, samples_.size());
  EXPECT_EQ(counters_.invalid, samples_.size());
}

TEST_F(SampleAssemblerTest, TheRangesOfAVehicleThatStandsAreTheFloorsWhateverItReports) {
  for (std::int64_t ms = 0; ms <= 800; ms += 100) {
    position(ms, 0.0);
    Reading height;
    height.stream = 3;
    height.at = device_ms(ms);
    height.height_m = ms < 300 ? 0.03 : ms < 600 ? 0.5 : 0.0;  // it takes off and lands
    height.is_flying = ms >= 300;                              // the firmware reports it for 2 s longer
    feed(height);
    ranges(ms, 0.0, {0.25F, 1.F, 32.766F, 1.F});
  }
  end();
  ASSERT_EQ(samples_.size(), 8U);
  for (const std::size_t standing : {0U, 1U, 2U, 6U, 7U})
    for (std::size_t beam = 0; beam < 4; ++beam)
      EXPECT_EQ(samples_[standing].status[beam], RangeStatus::kInvalid) << standing;
  for (const std::size_t flying : {3U, 4U, 5U}) {
    EXPECT_EQ(samples_[flying].status[0], RangeStatus::kHit) << flying;
    EXPECT_EQ(samples_[flying].status[2], RangeStatus::kNoReturn) << flying;
  }
  EXPECT_EQ(counters_.floor_returns, 0U);
}

/// A second in which the height is reported as 0, at positions by the time in milliseconds.
class WithoutHeight : public SampleAssemblerTest {
 protected:
  template <typename PositionAt>
  void travel(PositionAt x_m_at, std::optional<BodyTilt> tilt = std::nullopt) {
    for (std::int64_t ms = 0; ms <= 1000; ms += 100) {
      position(ms, x_m_at(ms));
      Reading height;
      height.stream = 3;
      height.at = device_ms(ms);
      height.height_m = 0.0;
      height.tilt = tilt;
      feed(height);
      ranges(ms);
    }
    end();
  }
};

TEST_F(WithoutHeight, WhatTravelsOnTheFloorHasAHeightThatNothingMeasures) {
  travel([](std::int64_t ms) { return 0.002 * static_cast<double>(ms); });
  ASSERT_EQ(samples_.size(), 10U);
  EXPECT_EQ(samples_[0].status[0], RangeStatus::kInvalid);
  for (std::size_t i = 4; i < samples_.size(); ++i) EXPECT_EQ(samples_[i].status[0], RangeStatus::kHit) << i;
}

TEST_F(WithoutHeight, WhatTravelsOnTheFloorDoesNotSeeTheFloorThoughItsTiltIsLogged) {
  travel([](std::int64_t ms) { return 0.002 * static_cast<double>(ms); }, BodyTilt());
  ASSERT_EQ(samples_.size(), 10U);
  EXPECT_EQ(samples_[0].status[0], RangeStatus::kInvalid);
  for (std::size_t i = 4; i < samples_.size(); ++i) EXPECT_EQ(samples_[i].status[0], RangeStatus::kHit) << i;
  EXPECT_EQ(counters_.floor_returns, 0U);
}

TEST_F(WithoutHeight, WhatHasTravelledOnTheFloorDoesNotStandWhereItComesBack) {
  travel([](std::int64_t ms) { return 0.002 * static_cast<double>(std::min(ms, 1000 - ms)); });
  ASSERT_EQ(samples_.size(), 10U);
  EXPECT_EQ(samples_[0].status[0], RangeStatus::kInvalid);
  EXPECT_EQ(samples_[9].status[0], RangeStatus::kHit);
}

TEST_F(SampleAssemblerTest, TellsTheStoreyByAltitudeLessHeight) {
  const auto fly_at = [this](std::int64_t from_ms, double altitude_m, std::optional<double> height_m) {
    for (std::int64_t ms = from_ms; ms < from_ms + 20'000; ms += 100) {
      position(ms, 0.0);
      Reading ground;
      ground.stream = 3;
      ground.at = device_ms(ms);
      ground.altitude_m = altitude_m;
      ground.height_m = height_m;
      feed(ground);
      ranges(ms + 4);
    }
    return index_of(samples_.back().storey);
  };
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(fly_at(0, 100.0, 0.5), 0U);
  EXPECT_EQ(fly_at(20'000, 101.5, 2.0), 0U) << "higher above the same ground";
  EXPECT_EQ(fly_at(40'000, 104.0, kNone), 0U) << "above a void";
  EXPECT_EQ(fly_at(60'000, 103.5, 0.5), 1U);
  EXPECT_EQ(fly_at(80'000, 100.5, 0.5), 0U);
}

TEST_F(SampleAssemblerTest, WaitsForLaterDeadReckoningAndKeepsTheOrder) {
  for (const int newer_ms : {0, 50}) {  // than the dead reckoning of the same stamp
    AssemblyConfig ageless = config();
    ageless.sensor.range_age = std::chrono::milliseconds(-newer_ms);
    SampleAssembler assembler(ageless, counters_);
    const auto add = [&assembler](std::uint8_t stream, std::int64_t ms) {
      Reading reading;
      reading.stream = stream;
      reading.at = device_ms(ms);
      if (stream == 1) {
        reading.position_odom = Point2{0.001 * static_cast<double>(ms), 0.0};
        reading.yaw_odom_rad = 0.0;
      } else {
        for (int i = 0; i < 4; ++i) EXPECT_TRUE(reading.distance_m.try_push_back(1.F));
      }
      assembler.add(reading);
    };
    add(1, 0);
    add(2, 20);
    add(2, 40);
    EXPECT_FALSE(assembler.take().has_value());
    add(1, 100);
    EXPECT_NEAR(assembler.take()->T_odom_body.x_m(), 0.02 + 0.001 * newer_ms, 1e-12);
    EXPECT_NEAR(assembler.take()->T_odom_body.x_m(), 0.04 + 0.001 * newer_ms, 1e-12);
    EXPECT_FALSE(assembler.take().has_value());
  }
}

TEST_F(SampleAssemblerTest, AHundredScansASecondMayWaitForDeadReckoningThatIsDelayed) {
  AssemblyConfig delayed = config();
  delayed.sensor.range_age = kMinRangeAge;
  SampleAssembler assembler(delayed, counters_);
  std::size_t samples = 0;
  for (std::int64_t ms = 0; ms <= 2000; ms += 10) {
    Reading reading;
    reading.stream = 1;
    reading.at = device_ms(ms);
    if (ms % 50 == 0) reading.position_odom = Point2();
    reading.yaw_odom_rad = 0.0;
    for (int i = 0; i < 4; ++i) EXPECT_TRUE(reading.distance_m.try_push_back(1.F));
    assembler.add(reading);
    while (assembler.take()) ++samples;
  }
  EXPECT_EQ(counters_.unpaired, 0U);
  EXPECT_GT(samples, 170U);
}

TEST_F(SampleAssemblerTest, WaitsForALimitedTime) {
  position(0, 0.0);
  for (int i = 1; i <= 20; ++i) ranges(100L * i);
  EXPECT_GE(counters_.unpaired, 15U);  // the position is lost: 0.3 s of ranges still wait
  EXPECT_EQ(samples_.size(), 0U + (counters_.samples));
  end();
  EXPECT_EQ(counters_.unpaired + counters_.samples, 20U);
}

TEST_F(SampleAssemblerTest, DropsRangesInAHoleOfTheDeadReckoningAndContinuesBehindIt) {
  for (int i = 0; i < 10; ++i) {
    if (i != 4) position(100L * i, 0.1 * i);
    ranges(100L * i + 4);
  }
  end();
  // Ranges are measured at 100 (i - 1) + 4: the lost position at 400 spoils those of 304 and 404.
  EXPECT_EQ(counters_.unpaired, 3U);
  ASSERT_EQ(samples_.size(), 7U);
  for (std::size_t i = 1; i < samples_.size(); ++i) EXPECT_FALSE(samples_[i].starts_segment);
  EXPECT_EQ(counters_.gaps, 0U);
}

/// Packets with pose and ranges every 100 ms, those for which `is_lost` left out: how many samples they make.
template <typename Lost>
std::size_t samples_of_packets(int count, Lost is_lost) {
  InputCounters counters;
  SampleAssembler assembler(config(), counters);
  assembler.set_periods(milliseconds(100), milliseconds(100));
  std::size_t samples = 0;
  for (int i = 0; i < count; ++i) {
    if (is_lost(i)) continue;
    Reading reading;
    reading.at = device_ms(100L * i);
    reading.position_odom = Point2{0.05 * i, 0.0};
    reading.yaw_odom_rad = 0.0;
    for (int beam = 0; beam < 4; ++beam) EXPECT_TRUE(reading.distance_m.try_push_back(1.F));
    assembler.add(reading);
    while (const auto sample = assembler.take()) {
      EXPECT_NEAR(sample->T_odom_body.x_m(), 0.5 * to_seconds(sample->measured_at.time_since_epoch()), 1e-9);
      ++samples;
    }
  }
  return samples;
}

/// Of ten seconds: ranges and yaw every 100 ms, a position every `period_ms`, those at `lost_ms` left out.
struct SparseFlight {
  InputCounters counters;
  std::vector<RangeSample> samples;
};
SparseFlight fly_sparsely(std::int64_t period_ms, const std::vector<std::int64_t>& lost_ms,
                          Duration stated_period) {
  SparseFlight flight;
  AssemblyConfig sparse = config();
  sparse.sensor.range_age = Duration::zero();
  SampleAssembler assembler(sparse, flight.counters);
  assembler.set_periods(stated_period, stated_period);
  const auto drain = [&] {
    while (const auto sample = assembler.take()) flight.samples.push_back(*sample);
  };
  for (std::int64_t ms = 0; ms <= 10'000; ms += 100) {
    Reading reading;
    reading.at = device_ms(ms);
    reading.yaw_odom_rad = 0.0;
    if (ms % period_ms == 0 && std::ranges::find(lost_ms, ms) == lost_ms.end())
      reading.position_odom = Point2{1e-4 * static_cast<double>(ms), 0.0};
    for (int beam = 0; beam < 4; ++beam) EXPECT_TRUE(reading.distance_m.try_push_back(1.F));
    assembler.add(reading);
    drain();
  }
  assembler.end();
  drain();
  return flight;
}

TEST(SampleAssembler, LearnsThePeriodOfTheDeadReckoningThatNobodyStates) {
  EXPECT_EQ(fly_sparsely(500, {}, Duration::zero()).samples.size(), 101U);
  EXPECT_EQ(fly_sparsely(1000, {}, Duration::zero()).samples.size(), 101U);
  EXPECT_EQ(fly_sparsely(200, {4000}, Duration::zero()).samples.size(), 101U) << "one is lost";
  EXPECT_EQ(fly_sparsely(200, {200}, Duration::zero()).samples.size(), 101U) << "before it is learnt";
  EXPECT_EQ(fly_sparsely(200, {4000, 4200}, Duration::zero()).samples.size(), 96U) << "two are lost";
}

TEST(SampleAssembler, LearnsFromPositionsAtTenHertzWhatIsUsual) {
  for (const std::vector<std::int64_t>& lost_ms :
       {std::vector<std::int64_t>{}, {100}, {100, 200}, {4000, 4100}, {100, 200, 300, 400, 500, 600, 700}}) {
    const SparseFlight stated = fly_sparsely(100, lost_ms, milliseconds(100));
    const SparseFlight learnt = fly_sparsely(100, lost_ms, Duration::zero());
    ASSERT_EQ(learnt.samples.size(), stated.samples.size());
    for (std::size_t i = 0; i < learnt.samples.size(); ++i)
      ASSERT_EQ(learnt.samples[i].measured_at, stated.samples[i].measured_at);
    EXPECT_EQ(learnt.counters.unpaired, stated.counters.unpaired);
  }
}

/// All come every 10 ms; two packets in a row with pose and tilt are lost.
TEST(SampleAssembler, InterpolatesWhatComesFasterThanUsualAsWhatIsUsualWhetherStatedOrLearnt) {
  for (const std::int64_t stated_ms : {10, 0}) {
    AssemblyConfig ageless = config();
    ageless.sensor.range_age = Duration::zero();
    InputCounters counters;
    SampleAssembler assembler(ageless, counters);
    assembler.set_periods(milliseconds(stated_ms), milliseconds(stated_ms));
    std::vector<RangeSample> samples;
    for (std::int64_t ms = 0; ms <= 1000; ms += 10) {
      Reading pose = whole_reading(ms, {});
      pose.tilt = BodyTilt{.x_up = 0.2, .y_up = 0.0};
      if (ms != 490 && ms != 500) assembler.add(pose);
      Reading ranges;
      ranges.stream = 2;
      ranges.at = device_ms(ms);
      for (int beam = 0; beam < 4; ++beam) EXPECT_TRUE(ranges.distance_m.try_push_back(1.F));
      assembler.add(ranges);
      while (const auto sample = assembler.take()) samples.push_back(*sample);
    }
    EXPECT_EQ(samples.size(), 101U) << stated_ms;
    for (const RangeSample& sample : samples)
      EXPECT_NEAR(sample.distance_m[0], std::sqrt(1.0 - 0.2 * 0.2), 1e-6) << stated_ms;
  }
}

TEST(SampleAssembler, CountsGapsByThePeriodOfTheRangesThatItLearns) {
  for (const std::int64_t period_ms : {20, 100, 500}) {
    InputCounters counters;
    SampleAssembler assembler(config(), counters);
    assembler.set_periods(Duration::zero(), Duration::zero());
    for (std::int64_t i = 0; i < 20; ++i) {
      if (i == 2 || i == 15 || i == 16) continue;
      Reading reading;
      reading.at = device_ms(i * period_ms + i % 2);
      for (int beam = 0; beam < 4; ++beam) EXPECT_TRUE(reading.distance_m.try_push_back(1.F));
      assembler.add(reading);
    }
    EXPECT_EQ(counters.gaps, 2U) << period_ms;
    EXPECT_EQ(counters.missing_packets, 3U) << period_ms;
  }
}

TEST(SampleAssembler, APacketThatIsLostAloneCostsItsOwnSampleOnly) {
  EXPECT_EQ(samples_of_packets(100, [](int) { return false; }), 99U);
  EXPECT_EQ(samples_of_packets(100, [](int i) { return i == 50; }), 98U);
  EXPECT_EQ(samples_of_packets(100, [](int i) { return i % 10 == 5; }), 89U);
  // Two in a row cost the one behind them too: the motion in so wide a hole is not known.
  EXPECT_EQ(samples_of_packets(100, [](int i) { return i == 50 || i == 51; }), 96U);
}

TEST_F(SampleAssemblerTest, CountsGapsAndThePacketsTheyStandFor) {
  for (const int i : {0, 1, 2, 4, 5, 9, 10}) ranges(100L * i);
  EXPECT_EQ(counters_.gaps, 2U);
  EXPECT_EQ(counters_.missing_packets, 4U);
}

TEST_F(SampleAssemblerTest, DropsAndCountsDuplicatesAndLatePackets) {
  for (int i = 0; i < 5; ++i) {
    position(100L * i, 0.1 * i);
    ranges(100L * i + 4);
  }
  position(400, 0.4);
  ranges(404);
  ranges(304);
  EXPECT_EQ(counters_.duplicates, 2U);
  EXPECT_EQ(counters_.out_of_order, 1U);
  EXPECT_EQ(counters_.range_packets, 5U);
}

TEST_F(SampleAssemblerTest, AfterARebootTheDeadReckoningRestarts) {
  for (int i = 0; i < 5; ++i) {
    position(60'000 + 100L * i, 3.0 + 0.01 * i);
    ranges(60'004 + 100L * i);
  }
  const std::size_t before = samples_.size();
  ASSERT_GT(before, 0U);
  for (int i = 0; i < 5; ++i) {
    position(2'000 + 100L * i, 0.01 * i);
    ranges(2'004 + 100L * i);
  }
  ASSERT_GT(samples_.size(), before + 1);
  EXPECT_TRUE(samples_[before].starts_segment);
  EXPECT_EQ(samples_[before].measured_at, device_ms(2'004));
  EXPECT_NEAR(samples_[before].T_odom_body.x_m(), 0.0004, 1e-9);
  EXPECT_FALSE(samples_[before + 1].starts_segment);
  EXPECT_EQ(counters_.segments, 2U);
  EXPECT_EQ(counters_.gaps, 0U);
  EXPECT_EQ(counters_.out_of_order, 0U);
}

TEST_F(SampleAssemblerTest, TimeContinuesWhenTheRangesChangeTheirBlock) {
  const std::vector<float> distances{1.F, 1.F, 1.F, 1.F};
  for (int ms = 0; ms <= 500; ms += 100) position(ms, 0.0);
  for (int ms = 200; ms <= 500; ms += 100) ranges(ms);
  for (const int late_ms : {350, 500}) ranges(late_ms, 0.0, distances, 3);
  position(600, 0.0);
  ranges(600, 0.0, distances, 3);
  end();
  EXPECT_EQ(counters_.out_of_order, 2U);
  ASSERT_GE(samples_.size(), 2U);
  for (std::size_t i = 1; i < samples_.size(); ++i)
    EXPECT_GT(samples_[i].measured_at, samples_[i - 1].measured_at);
}

TEST_F(SampleAssemblerTest, AfterARebootIntoOtherBlocksTheDeadReckoningRestarts) {
  const std::vector<float> distances{1.F, 1.F, 1.F, 1.F};
  for (int ms = 60'000; ms <= 60'500; ms += 100) {
    position(ms, 0.0);
    ranges(ms);
  }
  const std::size_t before = samples_.size();
  for (int ms = 2'000; ms <= 2'500; ms += 100) {
    ranges(ms, 0.0, distances, 3);
    position(ms, 5.0);
  }
  end();
  ASSERT_GT(samples_.size(), before);
  EXPECT_TRUE(samples_[before].starts_segment);
  EXPECT_EQ(counters_.out_of_order, 0U);
}

TEST_F(SampleAssemblerTest, AfterALongSilenceOrAJumpTheDeadReckoningRestarts) {
  std::int64_t ms = 0;
  const auto fly = [&](double from_x_m) {
    for (int i = 0; i < 5; ++i, ms += 100) {
      position(ms, from_x_m + 0.01 * i);
      ranges(ms + 4);
    }
  };
  fly(0.0);
  fly(20.0);
  ms += 5000;
  fly(20.1);
  end();
  EXPECT_EQ(counters_.segments, 3U);
  std::vector<std::size_t> starts;
  for (std::size_t i = 0; i < samples_.size(); ++i)
    if (samples_[i].starts_segment) starts.push_back(i);
  ASSERT_EQ(starts.size(), 3U);
  EXPECT_NEAR(samples_[starts[1]].T_odom_body.x_m(), 20.0, 0.05);
}

TEST_F(SampleAssemblerTest, CountsLeapsOfTheDeadReckoning) {
  for (int i = 0; i < 20; ++i) {
    position(100L * i, i < 10 ? 0.0 : 3.0);
    ranges(100L * i + 4, i < 15 ? 0.0 : 2.0);
  }
  end();
  EXPECT_EQ(counters_.leaps, 2U);
  EXPECT_EQ(counters_.segments, 3U);
}

TEST_F(SampleAssemblerTest, LeavesOutWhatTheDeadReckoningPutsBeyondItsReach) {
  AssemblyConfig bounded = config();
  bounded.continuity.farthest_m = 10.0;
  bounded.continuity.longest_silence = std::chrono::seconds(30);
  SampleAssembler assembler(bounded, counters_);
  const auto run_to = [&](std::int64_t ms, double x_m) {
    Reading reading;
    reading.at = device_ms(ms);
    reading.position_odom = Point2{x_m, 0.0};
    reading.yaw_odom_rad = 0.0;
    for (int beam = 0; beam < 4; ++beam) EXPECT_TRUE(reading.distance_m.try_push_back(1.F));
    assembler.add(reading);
    while (const auto sample = assembler.take()) samples_.push_back(*sample);
  };
  // Away at 4 m/s from 100 m on, and back.
  for (int i = 0; i < 100; ++i) run_to(100L * i, 100.0 + 0.4 * std::min(i, 99 - i));
  ASSERT_FALSE(samples_.empty());
  for (const RangeSample& sample : samples_) EXPECT_LE(sample.T_odom_body.x_m(), 110.0);
  EXPECT_EQ(counters_.too_far, 48U);
  EXPECT_EQ(counters_.samples, 51U);
  EXPECT_TRUE(samples_.back().T_odom_body.x_m() < 101.0) << "it has come back";
}

TEST_F(SampleAssemblerTest, ASilenceThatTheDeadReckoningSurvivesBeginsASegmentWithAGuess) {
  AssemblyConfig watched = config();
  watched.continuity.longest_silence = std::chrono::seconds(30);
  watched.continuity.unwatched_after = std::chrono::seconds(1);
  SampleAssembler assembler(watched, counters_);
  const auto fly = [&](std::int64_t ms, double x_m) {
    Reading reading;
    reading.at = device_ms(ms);
    reading.received = host_ms(ms);
    reading.position_odom = Point2{x_m, 0.0};
    reading.yaw_odom_rad = 0.0;
    for (int beam = 0; beam < 4; ++beam) EXPECT_TRUE(reading.distance_m.try_push_back(1.F));
    assembler.add(reading);
    while (const auto sample = assembler.take()) samples_.push_back(*sample);
  };
  std::int64_t ms = 0;
  const auto fly_for = [&](int packets) {
    for (int i = 0; i < packets; ++i, ms += 100) fly(ms, 0.0005 * static_cast<double>(ms));
  };
  fly_for(10);
  ms += 700;  // shorter: motion
  fly_for(10);
  ms += 3000;
  fly_for(10);
  ms += 40'000;
  fly_for(10);
  std::vector<std::pair<bool, bool>> starts;
  for (const RangeSample& sample : samples_)
    if (sample.starts_segment) starts.emplace_back(sample.starts_segment, sample.odometry_ran_on);
  EXPECT_EQ(starts, (std::vector<std::pair<bool, bool>>{{true, false}, {true, true}, {true, false}}));
  EXPECT_EQ(counters_.gaps, 3U);
  EXPECT_EQ(counters_.segments, 3U);
}

/// Of ten seconds: dead reckoning every `odometry_ms`, ranges every `range_ms`.
InputCounters fly_watched(std::int64_t odometry_ms, std::int64_t range_ms) {
  AssemblyConfig watched = config();
  watched.continuity.longest_silence = std::chrono::seconds(30);
  watched.continuity.unwatched_after = std::chrono::seconds(1);
  InputCounters counters;
  SampleAssembler assembler(watched, counters);
  assembler.set_periods(milliseconds(range_ms), milliseconds(odometry_ms));
  for (std::int64_t ms = 0; ms <= 10'000; ms += 100) {
    if (ms % odometry_ms == 0) assembler.add(whole_reading(ms, {}));
    if (ms % range_ms == 0) assembler.add(tilted_ranges(ms));
    while (assembler.take()) continue;
  }
  return counters;
}

TEST(SampleAssembler, RangesThatComeSeldomBeginNoSegmentWhereDeadReckoningGoesOn) {
  const InputCounters counters = fly_watched(100, 2000);
  EXPECT_EQ(counters.samples, 5U);  // the first is older than all dead reckoning
  EXPECT_EQ(counters.segments, 1U);
}

TEST(SampleAssembler, DeadReckoningThatIsInterpolatedAcrossASecondGoesOn) {
  const InputCounters counters = fly_watched(1000, 100);
  EXPECT_EQ(counters.samples, 100U);
  EXPECT_EQ(counters.segments, 1U);
}

TEST_F(SampleAssemblerTest, AfterARebootGapsAreCountedByTheHostsClock) {
  Reading reading;
  reading.stream = 2;
  for (int beam = 0; beam < 4; ++beam) EXPECT_TRUE(reading.distance_m.try_push_back(1.F));
  const auto on_frame = [&](std::uint32_t boot, std::int64_t device, std::int64_t host) {
    reading.boot = boot;
    reading.at = device_ms(device);
    reading.received = host_ms(host);
    feed(reading);
  };
  on_frame(0, 10'000'000, 0);
  on_frame(0, 10'000'100, 100);
  on_frame(1, 4000, 5100);  // forward or back: the time of another boot is unrelated
  on_frame(1, 4100, 5200);
  EXPECT_EQ(counters_.gaps, 1U);
  EXPECT_EQ(counters_.missing_packets, 49U);
}

TEST_F(SampleAssemblerTest, ClassifiesHitsNoReturnsAndInvalidReadings) {
  for (int i = 0; i < 3; ++i) {
    position(100L * i, 0.0);
    ranges(100L * i + 4, 0.0, {2.999F, 32.766F, 0.0F, std::numeric_limits<float>::quiet_NaN()});
  }
  ASSERT_EQ(samples_.size(), 2U);
  const RangeSample& sample = samples_[0];
  EXPECT_EQ(sample.beam_count, 4);
  EXPECT_EQ(sample.status[0], RangeStatus::kHit);
  EXPECT_FLOAT_EQ(sample.distance_m[0], 2.999F);
  EXPECT_EQ(sample.status[1], RangeStatus::kNoReturn);
  EXPECT_EQ(sample.distance_m[1], 0.0F);
  EXPECT_EQ(sample.status[2], RangeStatus::kInvalid);
  EXPECT_EQ(sample.status[3], RangeStatus::kInvalid);
  EXPECT_EQ(counters_.hits, 2U);
  EXPECT_EQ(counters_.no_returns, 2U);
  EXPECT_EQ(counters_.invalid, 4U);
}

TEST_F(SampleAssemblerTest, IgnoresDeadReckoningThatIsNotANumber) {
  position(0, 0.0);
  position(50, std::numeric_limits<double>::quiet_NaN());
  ranges(4);
  position(100, 0.1);
  ranges(104, std::numeric_limits<double>::infinity());
  position(200, 0.2);
  ranges(204);
  position(300, 0.3);
  ranges(304);
  end();
  ASSERT_GE(samples_.size(), 2U);
  for (const RangeSample& sample : samples_) {
    EXPECT_TRUE(std::isfinite(sample.T_odom_body.x_m()));
    EXPECT_TRUE(std::isfinite(sample.T_odom_body.yaw_rad()));
  }
  EXPECT_NEAR(samples_.back().T_odom_body.x_m(), 0.204, 1e-9);
}

TEST(ClassifyDistance, FollowsTheSensorsLimits) {
  SensorModel sensor;
  sensor.min_range_m = 0.05;
  sensor.max_range_m = 3.0;
  EXPECT_EQ(classify_distance(0.0, sensor), RangeStatus::kInvalid);
  EXPECT_EQ(classify_distance(0.049, sensor), RangeStatus::kInvalid);
  EXPECT_EQ(classify_distance(-1.0, sensor), RangeStatus::kInvalid);
  EXPECT_EQ(classify_distance(0.05, sensor), RangeStatus::kHit);
  EXPECT_EQ(classify_distance(2.999, sensor), RangeStatus::kHit);
  EXPECT_EQ(classify_distance(3.0, sensor), RangeStatus::kNoReturn);
  EXPECT_EQ(classify_distance(HUGE_VAL, sensor), RangeStatus::kNoReturn);
}

}  // namespace
}  // namespace swiftlet
