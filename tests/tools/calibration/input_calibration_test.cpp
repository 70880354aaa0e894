// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "tools/calibration/input_calibration.hpp"

#include <gmock/gmock.h>

namespace swiftlet {
namespace {

using testing::HasSubstr;
using testing::Not;
using testing::Optional;

/// A flight that shows its age and its scale.
InputCalibration found() {
  InputCalibration calibration{SensorModel::crazyflie(), SensorModel::crazyflie()};
  calibration.expected.range_age = std::chrono::milliseconds(100);
  calibration.found.range_age = std::chrono::milliseconds(123);
  calibration.found.odometry_calibration.forward_scale = 1.02;
  calibration.sigma(index_of(SystematicError::kRangeAge)) = 0.004;
  calibration.sigma(index_of(SystematicError::kForwardScale)) = 0.003;
  return calibration;
}

TEST(CalibrationNote, TellsWhatWasFoundAndExpected) {
  EXPECT_THAT(
      calibration_note(found(), found().found),
      Optional(std::string("by the input itself: age of the ranges 0.123 +- 0.004 s (0.100 expected), "
                           "scale of the odometry 1.020 +- 0.003 (1.000 expected)")));
}

TEST(CalibrationNote, TellsWhatIsSetAndKept) {
  SensorModel used = found().found;
  used.range_age = std::chrono::milliseconds(50);
  EXPECT_THAT(calibration_note(found(), used),
              Optional(HasSubstr("0.123 +- 0.004 s (0.050 set, kept), scale")));
}

TEST(CalibrationNote, LeavesOutWhatTheInputShowsNothingOf) {
  InputCalibration calibration = found();
  calibration.sigma(index_of(SystematicError::kForwardScale)) = 0.031;  // 0.032 is known beforehand
  EXPECT_THAT(calibration_note(calibration, calibration.found), Optional(Not(HasSubstr("scale"))));
  calibration.sigma(index_of(SystematicError::kRangeAge)) = 0.099;
  EXPECT_EQ(calibration_note(calibration, calibration.found), std::nullopt);
}

}  // namespace
}  // namespace swiftlet
