// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "tools/evaluation/relations_file.hpp"

#include <gmock/gmock.h>

#include <chrono>

#include "tests/support/temporary_file.hpp"

namespace swiftlet {
namespace {

using std::chrono::microseconds;

TEST(RelationsFile, TakesTimesPositionAndYaw) {
  const TemporaryFile file("a.relations",
                           "# t1 t2 x y z roll pitch yaw\n"
                           "90.239599 90.719599 0.42 -0.01 9 9 9 0.5\n\n1 2 3 4 0 0 0 -0.5\n");
  const Result<std::vector<Relation>> relations = read_relations_file(file.path());
  ASSERT_TRUE(relations.ok()) << relations.error().message;
  ASSERT_EQ(relations->size(), 2U);
  const Relation& first = relations->front();
  EXPECT_EQ(first.first.time_since_epoch(), microseconds(90'239'599));
  EXPECT_EQ(first.second.time_since_epoch(), microseconds(90'719'599));
  EXPECT_EQ(first.T_first_second.vector(), Eigen::Vector3d(0.42, -0.01, 0.5));
  EXPECT_EQ(relations->back().T_first_second.vector(), Eigen::Vector3d(3.0, 4.0, -0.5));
}

TEST(RelationsFile, NamesTheLineThatIsMalformed) {
  const TemporaryFile cut("cut.relations", "1 2 3 4 0 0 0 -0.5\n1 2 3 4\n");
  EXPECT_THAT(read_relations_file(cut.path()).error().message,
              testing::StartsWith(cut.path() + ":2: has 4 columns"));
  const TemporaryFile late("late.relations", "1 2e10 3 4 0 0 0 -0.5\n");
  EXPECT_THAT(read_relations_file(late.path()).error().message,
              testing::StartsWith(late.path() + ":1: column 2"));
}

}  // namespace
}  // namespace swiftlet
