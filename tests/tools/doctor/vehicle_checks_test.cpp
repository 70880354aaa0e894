// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "tools/doctor/vehicle_checks.hpp"

#include <gmock/gmock.h>

#include <algorithm>

namespace swiftlet {
namespace {

using testing::AllOf;
using testing::Each;
using testing::Field;
using testing::HasSubstr;

class VehicleChecks : public testing::Test {
 protected:
  VehicleChecks() {
    facts_.answered = true;
    facts_.protocol = 12;
    facts_.firmware = "2026.08";
    facts_.device_type = "Crazyflie 2.1";
    facts_.has_multiranger = true;
    facts_.has_flow_deck = true;
    facts_.logs = true;
    facts_.health.battery_mv = 4100;
    facts_.health.is_flying = false;
  }
  Finding check(const std::string& name) const {
    const Findings findings = check_vehicle(facts_);
    const auto found = std::find_if(findings.begin(), findings.end(),
                                    [&name](const Finding& finding) { return finding.check == name; });
    return found == findings.end() ? Finding{} : *found;
  }

  VehicleFacts facts_;
};

TEST_F(VehicleChecks, AGoodVehicleIsOkThroughout) {
  EXPECT_THAT(check_vehicle(facts_),
              AllOf(Each(Field(&Finding::mark, Mark::kOk)), Each(Field(&Finding::remedy, ""))));
  EXPECT_EQ(check("vehicle firmware").found, "2026.08, CRTP protocol 12");
  EXPECT_EQ(check("battery").found, "4.10 V");
}

TEST_F(VehicleChecks, ProtocolsFromFourToTwelveAreKnown) {
  facts_.protocol = 3;
  EXPECT_EQ(check("vehicle firmware").mark, Mark::kProblem);
  facts_.protocol = 4;
  EXPECT_EQ(check("vehicle firmware").mark, Mark::kOk);
  facts_.protocol = 13;
  EXPECT_EQ(check("vehicle firmware").mark, Mark::kWarning);
  facts_.protocol = 0;
  EXPECT_EQ(check("vehicle firmware").mark, Mark::kProblem);
}

TEST_F(VehicleChecks, FirmwareWithoutARangeFilterIsAWarning) {
  facts_.firmware = "2022.05";
  EXPECT_EQ(check("vehicle firmware").mark, Mark::kWarning);
  EXPECT_THAT(check("vehicle firmware").remedy, HasSubstr("2022.09"));
  facts_.firmware = "2022.09";
  EXPECT_EQ(check("vehicle firmware").mark, Mark::kOk);
  facts_.firmware = "1f2e3d4 dev";
  EXPECT_EQ(check("vehicle firmware").mark, Mark::kOk);
}

TEST_F(VehicleChecks, AMissingDeckIsAProblemAndSilenceAboutItAWarning) {
  facts_.has_multiranger = false;
  facts_.has_flow_deck = std::nullopt;
  EXPECT_EQ(check("multiranger").mark, Mark::kProblem);
  EXPECT_THAT(check("multiranger").found, HasSubstr("no ranges"));
  EXPECT_EQ(check("flow deck").mark, Mark::kWarning);
}

TEST_F(VehicleChecks, MissingLogVariablesAreNamed) {
  facts_.refusal = Error{ErrorCode::kInvalidInput, "does not offer the log variables range.front"};
  EXPECT_EQ(check("log").mark, Mark::kProblem);
  EXPECT_THAT(check("log").found, HasSubstr("range.front"));
  facts_.refusal.reset();
  facts_.logs = false;
  EXPECT_EQ(check("log").mark, Mark::kProblem);
}

TEST_F(VehicleChecks, ALowBatteryIsToldByItsVoltageAtRest) {
  facts_.health.battery_mv = 3600;
  EXPECT_EQ(check("battery").mark, Mark::kWarning);
  facts_.health.is_flying = true;
  EXPECT_EQ(check("battery").mark, Mark::kOk);
  facts_.health.battery_is_low = true;
  EXPECT_EQ(check("battery").mark, Mark::kProblem);
  facts_.health = {};
  EXPECT_EQ(check("battery").mark, Mark::kSkipped);
}

TEST_F(VehicleChecks, StandingHintsAtTheYawTrapAndFlyingIsNoTimeToAsk) {
  EXPECT_THAT(check("motors").found, HasSubstr("yaw"));
  facts_.health.is_flying = true;
  EXPECT_EQ(check("motors").mark, Mark::kWarning);
  facts_.health.is_flying.reset();
  EXPECT_EQ(check("motors").mark, Mark::kSkipped);
}

TEST_F(VehicleChecks, SkippedTheyBearTheSameNames) {
  const Findings done = check_vehicle(facts_);
  const Findings skipped = skip_vehicle("no dongle");
  ASSERT_EQ(done.size(), skipped.size());
  for (std::size_t i = 0; i < done.size(); ++i) EXPECT_EQ(done[i].check, skipped[i].check);
  EXPECT_THAT(skipped,
              Each(AllOf(Field(&Finding::mark, Mark::kSkipped), Field(&Finding::found, "no dongle"))));
}

}  // namespace
}  // namespace swiftlet
