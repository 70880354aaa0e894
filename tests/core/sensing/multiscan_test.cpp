// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "core/sensing/multiscan.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <memory>

#include "tests/support/numeric_jacobian.hpp"
#include "tests/support/random_geometry.hpp"

namespace swiftlet {
namespace {

RangeSample hits(std::initializer_list<float> distances_m) {
  RangeSample sample;
  for (const float distance_m : distances_m) {
    sample.distance_m[sample.beam_count] = distance_m;
    sample.status[sample.beam_count++] = distance_m > 0.0F ? RangeStatus::kHit : RangeStatus::kNoReturn;
  }
  return sample;
}

UncertainMotion step(double x_m, double y_m, double yaw_rad) {
  return uncertain_step(OdometryNoise(), Pose2(x_m, y_m, yaw_rad), std::chrono::milliseconds(100));
}

class MultiscanTest : public testing::Test {
 protected:
  Multiscan& make(std::size_t points) {
    multiscan_ = std::make_unique<Multiscan>(SensorModel(), BeamLayout::multiranger(), points);
    return *multiscan_;
  }
  const MultiscanView& assembled() {
    multiscan_->assemble(*view_);
    return *view_;
  }

 private:
  std::unique_ptr<Multiscan> multiscan_;
  std::unique_ptr<MultiscanView> view_ = std::make_unique<MultiscanView>();
};

/// Of a vehicle that has flown far.
std::size_t scans_held(Multiscan multiscan) {
  for (std::size_t i = 0; i < 2 * kMaxMultiscanScans; ++i) multiscan.add(hits({1.0F}), step(0.2, 0.0, 0.0));
  return multiscan.size();
}

TEST_F(MultiscanTest, HoldsAsManyScansAsMakeThePoints) {
  EXPECT_EQ(scans_held(make(120)), 30U);
  BeamLayout laser;
  laser.count = 11;
  EXPECT_EQ(scans_held(Multiscan(SensorModel(), laser, 120)), 11U);
  laser.count = kMaxBeams;
  EXPECT_EQ(scans_held(Multiscan(SensorModel(), laser, 30)), 2U);
}

TEST_F(MultiscanTest, KeepsHitsWithinTheSensorsRangeOnly) {
  Multiscan& multiscan = make(120);
  multiscan.add(hits({1.0F, 0.0F, 9.0F, 0.01F}), {});
  const MultiscanView& view = assembled();
  ASSERT_EQ(view.points.size(), 1U);
  EXPECT_NEAR(view.points[0].p_body.x_m, 1.0, 1e-6);
  EXPECT_EQ(view.points[0].beam, 0);
}

TEST_F(MultiscanTest, SeesAStandingPointWhereItIsFromThePresentPose) {
  Multiscan& multiscan = make(120);
  multiscan.add(hits({2.0F, 0.0F, 0.0F, 0.0F}), {});  // at (2, 0)
  multiscan.add(hits({0.0F, 0.0F, 0.0F, 0.0F}), step(0.5, 0.0, kPi / 2.0));
  multiscan.add(hits({0.0F, 0.0F, 0.0F, 0.0F}), step(1.0, 0.0, 0.0));  // now at (0.5, 1) facing +y
  const MultiscanView& view = assembled();
  ASSERT_EQ(view.points.size(), 1U);
  EXPECT_NEAR(view.points[0].p_body.x_m, -1.0, 1e-6);
  EXPECT_NEAR(view.points[0].p_body.y_m, -1.5, 1e-6);
  EXPECT_NEAR(view.points[0].direction.y_m, -1.0, 1e-6);
  EXPECT_EQ(view.points[0].scan, 0);
}

TEST_F(MultiscanTest, ForgetsTheOldestScanWhenFull) {
  Multiscan& multiscan = make(12);  // three scans
  for (int i = 0; i < 5; ++i)
    multiscan.add(hits({1.0F + static_cast<float>(i) * 0.1F, 0.0F, 0.0F, 0.0F}), step(0.2, 0.0, 0.0));
  const MultiscanView& view = assembled();
  ASSERT_EQ(view.points.size(), 3U);
  EXPECT_NEAR(view.points[0].p_body.x_m, 1.2 - 0.4, 1e-6);
  EXPECT_NEAR(view.points[2].p_body.x_m, 1.4, 1e-6);
}

TEST_F(MultiscanTest, DoesNotFillUpWhileTheVehicleStandsStill) {
  Multiscan& multiscan = make(120);
  multiscan.add(hits({1.0F, 1.0F, 1.0F, 1.0F}), {});
  for (int i = 0; i < 50; ++i) multiscan.add(hits({1.0F, 1.0F, 1.0F, 1.0F}), step(0.0, 0.0, 0.0));
  EXPECT_EQ(multiscan.size(), 2U);
}

TEST_F(MultiscanTest, LosesNoMotionWhenShortStepsReplaceEachOther) {
  Multiscan& multiscan = make(120);
  multiscan.add(hits({2.0F, 0.0F, 0.0F, 0.0F}), {});
  UncertainMotion total;
  for (int i = 0; i < 12; ++i) {
    multiscan.add(hits({0.0F, 0.0F, 0.0F, 0.0F}), step(0.003, 0.001, 0.01));
    total = total * step(0.003, 0.001, 0.01);
  }
  const MultiscanView& view = assembled();
  EXPECT_LT(view.scans, 13U);
  const Point2 expected = total.T_from_to.inverse() * Point2{2.0, 0.0};
  ASSERT_EQ(view.points.size(), 1U);
  EXPECT_NEAR(view.points[0].p_body.x_m, expected.x_m, 1e-6);
  EXPECT_NEAR(view.points[0].p_body.y_m, expected.y_m, 1e-6);
}

TEST_F(MultiscanTest, StartsEmptyAfterARestart) {
  Multiscan& multiscan = make(120);
  multiscan.add(hits({1.0F, 1.0F, 1.0F, 1.0F}), {});
  multiscan.add(hits({1.0F, 1.0F, 1.0F, 1.0F}), step(0.1, 0.0, 0.0));
  multiscan.restart();
  EXPECT_EQ(multiscan.size(), 0U);
  multiscan.add(hits({1.0F, 0.0F, 0.0F, 0.0F}), step(9.0, 9.0, 1.0));
  EXPECT_NEAR(assembled().points[0].p_body.x_m, 1.0, 1e-6);
}

TEST_F(MultiscanTest, CountsTheScansThatWereNotInTheViewBefore) {
  Multiscan& multiscan = make(120);
  for (int i = 0; i < 4; ++i) multiscan.add(hits({1.0F, 1.0F, 1.0F, 1.0F}), step(0.1, 0.0, 0.0));
  EXPECT_EQ(assembled().new_scans, 4U);
  for (int i = 0; i < 2; ++i) multiscan.add(hits({1.0F, 1.0F, 1.0F, 1.0F}), step(0.1, 0.0, 0.0));
  const MultiscanView& view = assembled();
  EXPECT_EQ(view.scans, 6U);
  EXPECT_EQ(view.new_scans, 2U);
}

// Eqs. (16) and (17): the covariance that the motions give a point must be that of u_it propagated through
// the transformation of the point, here by central differences.
TEST_F(MultiscanTest, MotionErrorsDisplaceAPointAsFirstOrderPropagationSays) {
  test::RandomGeometry random(1);
  for (int draw = 0; draw < 20; ++draw) {
    Multiscan& multiscan = make(120);
    multiscan.add(hits({2.5F, 0.0F, 0.0F, 0.0F}), {});
    UncertainMotion u;
    for (int i = 0; i < 6; ++i) {
      const UncertainMotion motion =
          step(random.uniform(0.1, 0.3), random.uniform(-0.1, 0.1), random.uniform(-0.3, 0.3));
      multiscan.add(hits({0.0F, 0.0F, 0.0F, 0.0F}), motion);
      u = u * motion;
    }
    const MultiscanView& view = assembled();
    const Point2 p = view.points[0].p_body;
    Eigen::Matrix<double, 2, 3> J_displacement;
    J_displacement << 1.0, 0.0, -p.y_m, 0.0, 1.0, p.x_m;
    Eigen::Matrix2d covariance = Eigen::Matrix2d::Zero();
    for (const Eigen::Matrix3d& motion : view.motion_covariance)
      covariance += J_displacement * motion * J_displacement.transpose();

    const auto g = [](const Eigen::Vector3d& v) {
      const Point2 moved = test::pose_of(v).inverse() * Point2{2.5, 0.0};
      return Eigen::Vector2d(moved.x_m, moved.y_m);
    };
    const Eigen::Matrix<double, 2, 3> J_u = test::numeric_jacobian<2, 3>(g, u.T_from_to.vector());
    EXPECT_TRUE(covariance.isApprox(J_u * u.covariance * J_u.transpose(), 1e-6));
  }
}

TEST(MultiscanDeathTest, RefusesMorePointsThanItsViewHolds) {
  BeamLayout laser;
  laser.count = kMaxBeams;
  EXPECT_DEATH(Multiscan(SensorModel(), laser, kMaxMultiscanPoints + 1), "points fit its view");
}

}  // namespace
}  // namespace swiftlet
