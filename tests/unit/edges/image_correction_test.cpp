// SPDX-License-Identifier: BSD-3-Clause
// Rolling shutter: image motion, displaced position of a point, and the inverse.
#include "edgevo/edges/image_correction.h"

#include <gmock/gmock.h>

#include <limits>

#include "edgevo/core/radial.h"
#include "support/numerical_jacobian.h"
#include "support/pose_matchers.h"

namespace edgevo {
namespace {

const Pinhole kCamera{520, 515, 320, 240, 640, 480};

ImageMotion motion_at(double idepth) {
  ImageMotion m;
  m.velocity << 0.3, -0.2, 0.25, 0.1, -0.3, 0.2;
  m.idepth.setConstant(idepth);
  return m;
}

std::vector<Eigen::Vector2d> points() {
  std::vector<Eigen::Vector2d> all;
  for (double v = 20; v < 480; v += 55)
    for (double u = 15; u < 640; u += 60) all.push_back(kCamera.ray({u, v}).head<2>());
  return all;
}

// Position of a point `seconds` after the time of the middle row.
Eigen::Vector2d later(const ImageMotion& m, double idepth, const Eigen::Vector2d& x, double seconds) {
  const Eigen::Vector3d X =
      SE3::exp(seconds * m.velocity) * Eigen::Vector3d(Eigen::Vector3d(x.x(), x.y(), 1) / idepth);
  return X.head<2>() / X.z();
}

TEST(ImageMotion, IsTheVelocityOfProjectedPoints) {
  const double idepth = 0.7;
  const ImageMotion m = motion_at(idepth);
  for (const Eigen::Vector2d& x : points()) {
    const auto shown = [&](const Eigen::Matrix<double, 1, 1>& seconds) {
      return later(m, idepth, x, seconds[0]);
    };
    EXPECT_THAT(m.at(kCamera, x), test::JacobianNear(test::numerical_jacobian<1>(shown), 1e-9));
  }
}

TEST(ImageMotion, UsesTheDepthOfTheCell) {
  ImageMotion m;
  m.velocity << 1, 0, 0, 0, 0, 0;  // dx/dt = idepth
  m.idepth.setConstant(0.5);
  m.idepth(2, 7) = 2;
  const auto idepth_at = [&](double u, double v) { return m.at(kCamera, kCamera.ray({u, v}).head<2>()).x(); };
  const double cell_width = 640.0 / ImageMotion::kColumns, cell_height = 480.0 / ImageMotion::kRows;
  EXPECT_NEAR(idepth_at(7.5 * cell_width - 0.5, 2.5 * cell_height - 0.5), 2.0, 1e-9);
  EXPECT_NEAR(idepth_at(8 * cell_width - 0.5, 2.5 * cell_height - 0.5), 1.25, 1e-9);
  EXPECT_NEAR(idepth_at(3 * cell_width, 5 * cell_height), 0.5, 1e-9);
  for (const double u : {-50.0, 0.0, 639.0, 700.0})
    for (const double v : {-50.0, 0.0, 479.0, 600.0})
      EXPECT_NEAR(idepth_at(u, v), 0.5, 1e-9) << u << " " << v;
}

TEST(ImageMotion, ANanPointReadsNoMemoryOutside) {
  const double none = std::numeric_limits<double>::quiet_NaN(), far = std::numeric_limits<double>::infinity();
  EXPECT_FALSE(motion_at(1).at(kCamera, {none, none}).allFinite());
  EXPECT_FALSE(motion_at(1).at(kCamera, {far, -far}).allFinite());
}

TEST(ImageMotion, IsUnknownByDefault) {
  EXPECT_FALSE(ImageMotion().is_known());
  const Eigen::Vector2d x(0.3, -0.2);
  EXPECT_EQ(add_rolling(kCamera, 0.05, ImageMotion(), x), x);
  EXPECT_EQ(from_file(kCamera, {0, 0.05}, ImageMotion(), x), x);
}

// A row in the upper half is exposed earlier, one in the lower half later, and the shift matches the true
// motion to second order.
TEST(ImageCorrection, EachRowShowsAPointAtItsOwnTime) {
  const double idepth = 0.7, readout_s = 0.02;
  const ImageMotion m = motion_at(idepth);
  for (const Eigen::Vector2d& x : points()) {
    const Eigen::Vector2d shown = add_rolling(kCamera, readout_s, m, x);
    const Eigen::Vector2d truth = later(m, idepth, x, readout_s * shutter_row(kCamera, shown));
    EXPECT_LT((shown - truth).norm(), 0.02 * (truth - x).norm() + 1e-12);
  }
  EXPECT_NEAR(shutter_row(kCamera, kCamera.ray({100, 0}).head<2>()), -0.5, 1e-12);
  EXPECT_NEAR(shutter_row(kCamera, kCamera.ray({100, 479}).head<2>()), 0.5, 1e-12);
}

// With a rate of rotation that changes: the position at each row's time, of motion integrated step by step.
TEST(ImageCorrection, ARateThatChangesMovesThePointsByItsSquare) {
  const double idepth = 0.7, readout_s = 0.03;
  ImageMotion m = motion_at(idepth);
  m.turning << 20, -30, 25;
  double error = 0, without = 0;
  for (const Eigen::Vector2d& x : points()) {
    const Eigen::Vector2d shown = add_rolling(kCamera, readout_s, m, x);
    const double t = readout_s * shutter_row(kCamera, shown);
    Eigen::Vector3d X = x.homogeneous() / idepth;
    const int steps = 200;
    for (int i = 0; i < steps; ++i) {
      Vector6d twist = m.velocity;
      twist.tail<3>() += (i + 0.5) / steps * t * m.turning;
      X = SE3::exp(t / steps * twist) * X;
    }
    error += (shown - X.hnormalized()).norm();
    without += (add_rolling(kCamera, readout_s, motion_at(idepth), x) - X.hnormalized()).norm();
  }
  EXPECT_LT(error, 0.1 * without);
  EXPECT_GT(without / double(points().size()) * kCamera.fx, 0.2);  // pixels
}

TEST(ImageMotion, TheAccelerationIsThatOfProjectedPoints) {
  const double idepth = 0.7, step = 1e-3;
  ImageMotion m = motion_at(idepth);
  m.turning.setConstant(1e-12);  // known, and nothing
  for (const Eigen::Vector2d& x : points()) {
    const Eigen::Vector2d second =
        (later(m, idepth, x, step) - 2 * x + later(m, idepth, x, -step)) / (step * step);
    EXPECT_LT((m.acceleration(kCamera, x) - second).norm(), 1e-5);
  }
}

// The row that counts is that of the raw pixel at which the moved point appears, whatever lens and whatever
// pinhole the images are rectified to.
TEST(ImageCorrection, TheRowIsThatOfTheRawPixel) {
  const Camera camera({520, 515, 320, 240, 640, 480}, {-0.2, 0, 0, 0, 0});
  const Rectification rectification(camera, {350, 352, 260, 180, 500, 380});
  const double readout_s = 0.04;
  const ImageMotion m = motion_at(0.7);
  for (const Eigen::Vector2d& x : points()) {
    const Eigen::Vector2d shown = add_rolling(rectification, readout_s, m, x);
    const double row = rectification.raw_pixel(shown).y() / 479 - 0.5;
    const Eigen::Vector2d shift = readout_s * row * m.at(rectification.target(), x);
    EXPECT_LT((shown - x - shift).norm(), 0.005 * shift.norm() + 1e-12);
  }
}

// A file with a shorter focal length, corrected, shows each point where the true camera does, also in the
// rows that a rolling shutter reads.
TEST(ImageCorrection, ACorrectedFocalLengthIsThatOfTheTrueCamera) {
  Pinhole file = kCamera;
  file.fx /= 1.25, file.fy /= 1.25;
  for (const Eigen::Vector2d& x : points()) {
    const ImageMotion m = motion_at(0.7);
    const Eigen::Vector2d truth = to_file(kCamera, {0, 0.04}, m, x),
                          by_file = to_file(file, {0, 0.04, 0.25}, m, x);
    const Eigen::Vector2d px = kCamera.project(truth.homogeneous());
    EXPECT_LT((file.project(by_file.homogeneous()) - px).norm(),
              0.01 * (kCamera.project(x.homogeneous()) - px).norm() + 0.01);
    EXPECT_LT((from_file(file, {0.01, 0.04, 0.25}, m, to_file(file, {0.01, 0.04, 0.25}, m, x)) - x).norm(),
              1e-9);
  }
}

TEST(ImageCorrection, TheRateByTheReadOutTimeIsItsDerivative) {
  ImageMotion m = motion_at(0.6);
  m.turning << 20, -30, 25;
  for (const Eigen::Vector2d& x : points()) {
    const auto shown = [&](const Eigen::Matrix<double, 1, 1>& d) -> Eigen::Vector2d {
      return add_rolling(kCamera, 0.03 + d[0], m, x);
    };
    EXPECT_THAT(rolling_rate(kCamera, 0.03, m, x),
                test::JacobianNear(test::numerical_jacobian<1>(shown), 1e-8));
  }
}

TEST(ImageCorrection, TheInverseIsExact) {
  for (const double readout_s : {-0.05, 0.0, 0.02, 0.1})
    for (const double k1 : {-0.01, 0.0, 0.02}) {
      const ImageCorrection c{k1, readout_s};
      const ImageMotion m = motion_at(0.8);
      for (const Eigen::Vector2d& x : points())
        EXPECT_LT((from_file(kCamera, c, m, to_file(kCamera, c, m, x)) - x).norm(), 1e-11);
    }
}

// There is no inverse if rows overtake one another.
TEST(ImageCorrection, UnderVeryFastMotionOnlyTheLensIsCorrected) {
  for (const double factor : {30.0, 1e3, 1e150}) {
    ImageMotion m = motion_at(0.8);
    m.velocity *= factor;
    int lens_alone = 0;
    for (const Eigen::Vector2d& x : points()) {
      const Eigen::Vector2d back = from_file(kCamera, {0.01, 0.1}, m, x);
      EXPECT_TRUE(back.allFinite()) << factor;
      lens_alone += back == remove_radial(0.01, x);
    }
    EXPECT_GT(lens_alone, 0) << factor;
  }
}

TEST(ImageCorrection, WithoutAReadOutTimeOnlyTheLensRemains) {
  for (const Eigen::Vector2d& x : points()) {
    EXPECT_EQ(to_file(kCamera, {0.013, 0}, motion_at(1), x), add_radial(0.013, x));
    EXPECT_EQ(from_file(kCamera, {0.013, 0}, motion_at(1), x), remove_radial(0.013, x));
    EXPECT_EQ(file_jacobian(kCamera, {0.013, 0}, motion_at(1), x), radial_jacobian(0.013, x));
  }
}

TEST(ImageCorrection, TheJacobianMatchesNumericDifferentiation) {
  const ImageCorrection c{0.015, 0.03};
  const ImageMotion m = motion_at(0.6);
  for (const Eigen::Vector2d& x : points()) {
    const auto in_file = [&](const Eigen::Vector2d& d) -> Eigen::Vector2d {
      return to_file(kCamera, c, m, x + d);
    };
    EXPECT_THAT(file_jacobian(kCamera, c, m, x),
                test::JacobianNear(test::numerical_jacobian<2>(in_file, 1e-6), 1e-6));
  }
}

}  // namespace
}  // namespace edgevo
