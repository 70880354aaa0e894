// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "firmware_link/simulation/param_table.hpp"

#include <gtest/gtest.h>

#include <set>
#include <string>

namespace swiftlet {
namespace {

const ParamDescription& param(std::string_view group, std::string_view name) {
  return simulated_param_table()[simulated_param_id(group, name)];
}

TEST(ParamTable, HasSomeHundredDistinctNamesThatFitTheWire) {
  std::set<std::string> names;
  for (const ParamDescription& entry : simulated_param_table()) {
    EXPECT_TRUE(names.insert(std::string(entry.group) + "." + std::string(entry.name)).second)
        << entry.group << "." << entry.name;
    EXPECT_FALSE(entry.name.empty());
    EXPECT_LE(entry.group.size() + entry.name.size(), 24U) << entry.group << "." << entry.name;
    EXPECT_GT(param_type_size(entry.type), 0U);
  }
  EXPECT_GE(names.size(), 240U);
}

TEST(ParamTable, DescribesParametersAsTheFirmwareDoes) {
  EXPECT_EQ(param("deck", "bcMultiranger").type, ParamType::kUint8);
  EXPECT_EQ(param("deck", "bcMultiranger").flags, kParamCore | kParamReadOnly);
  EXPECT_EQ(param("kalman", "initialYaw").type, ParamType::kFloat);
  EXPECT_EQ(param("kalman", "initialYaw").flags, kParamCore);
  EXPECT_EQ(param("multiranger", "filterMask").type, ParamType::kUint16);
  EXPECT_EQ(param("multiranger", "filterMask").flags, 0);
  EXPECT_EQ(param("kalman", "pNAcc_xy").flags, kParamCore | kParamPersistent);
  EXPECT_EQ(param("supervisor", "landedTimeout").flags, kParamPersistent);
  EXPECT_EQ(param("pid_rate", "roll_kp").flags, kParamPersistent);
}

TEST(ParamTable, HoldsDefaultValues) {
  EXPECT_EQ(param("multiranger", "filterMask").default_value, 1.0);
  EXPECT_EQ(param("pid_rate", "roll_kd").default_value, 2.5);
  EXPECT_EQ(param("kalman", "initialX").default_value, 0.0);
  EXPECT_EQ(param("colAv", "bboxMinX").default_value, -1000.0);
}

TEST(ParamTable, HasAKeyThatIsTheSameEachTime) {
  EXPECT_EQ(simulated_param_table_crc(), simulated_param_table_crc());
  EXPECT_NE(simulated_param_table_crc(), 0U);
}

TEST(ParamTable, HasNoIdForAnUnknownName) {
  EXPECT_DEATH(static_cast<void>(simulated_param_id("no", "such")), "parameters that it has");
}

}  // namespace
}  // namespace swiftlet
