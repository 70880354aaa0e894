// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "core/geometry/covariance3.hpp"

#include <gtest/gtest.h>

namespace swiftlet {
namespace {

TEST(Covariance3, GivesBackTheMatrixItWasMadeOf) {
  Eigen::Matrix3d P;
  P << 1.0, 0.1, 0.2, 0.1, 2.0, 0.3, 0.2, 0.3, 3.0;
  EXPECT_EQ(Covariance3::from_matrix(P).matrix(), P);
}

}  // namespace
}  // namespace swiftlet
