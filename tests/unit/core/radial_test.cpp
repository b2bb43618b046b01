// SPDX-License-Identifier: BSD-3-Clause
// Residual radial distortion: inverse, derivatives, and its position in the camera model.
#include "edgevo/core/radial.h"

#include <gmock/gmock.h>

#include "edgevo/core/rectification.h"
#include "support/numerical_jacobian.h"
#include "support/pose_matchers.h"

namespace edgevo {
namespace {

TEST(Radial, RemovingUndoesAdding) {
  for (const double k1 : {-0.03, -0.01, 0.0, 0.012, 0.03})
    for (double y = -0.8; y <= 0.8; y += 0.2)
      for (double x = -1.2; x <= 1.2; x += 0.2) {
        const Eigen::Vector2d p(x, y);
        EXPECT_LT((remove_radial(k1, add_radial(k1, p)) - p).norm(), 1e-12) << k1 << " at " << p.transpose();
      }
}

TEST(Radial, TheCentreStays) {
  EXPECT_EQ(remove_radial(0.02, Eigen::Vector2d::Zero()), Eigen::Vector2d::Zero());
}

TEST(Radial, DerivativesAreTheNumericOnes) {
  const double k1 = 0.017;
  for (const Eigen::Vector2d& x :
       {Eigen::Vector2d(0.7, -0.2), Eigen::Vector2d(-0.3, 0.5), Eigen::Vector2d(0, 0)}) {
    const auto by_point = [&](const Eigen::Vector2d& d) -> Eigen::Vector2d { return add_radial(k1, x + d); };
    const auto by_k1 = [&](const Eigen::Matrix<double, 1, 1>& d) -> Eigen::Vector2d {
      return add_radial(k1 + d[0], x);
    };
    EXPECT_THAT(radial_jacobian(k1, x), test::JacobianNear(test::numerical_jacobian<2>(by_point), 1e-9));
    EXPECT_THAT(radial_derivative(x), test::JacobianNear(test::numerical_jacobian<1>(by_k1), 1e-9));
  }
}

TEST(Radial, ActsBeforeTheDistortionOfTheFile) {
  const Camera file({517.3, 516.5, 318.6, 255.3, 640, 480},
                    {0.262383, -0.953104, -0.005358, 0.002628, 1.163314});
  const Rectification rectification(file);
  const RectificationMaps maps = rectification.maps({0.01});
  for (int v = 0; v < 480; v += 60)
    for (int u = 0; u < 640; u += 60) {
      const Eigen::Vector2d x = file.pinhole().ray({double(u), double(v)}).head<2>();
      const Eigen::Vector2d px = rectification.raw_pixel(add_radial(0.01, x));
      EXPECT_NEAR(maps.x[size_t(v * 640 + u)], px.x(), 1e-4);
      EXPECT_NEAR(maps.y[size_t(v * 640 + u)], px.y(), 1e-4);
      const auto ray = file.unproject(px);
      ASSERT_TRUE(ray);
      EXPECT_LT((remove_radial(0.01, ray->head<2>() / ray->z()) - x).norm(), 1e-9);
    }
}

TEST(Radial, AnotherFocalLengthScalesTheImage) {
  const ImageCorrection lens{0.01, 0, 0.25};
  const Eigen::Vector2d x(0.4, -0.2);
  EXPECT_LT((add_lens(lens, x) - 1.25 * add_radial(0.01, x)).norm(), 1e-15);
  EXPECT_LT((remove_lens(lens, add_lens(lens, x)) - x).norm(), 1e-12);
}

// Where the true lens is longer than the file's, the image of the file's does not reach the border.
TEST(Radial, PixelsOutsideTheImageOfALongerLensAreMissing) {
  const Rectification rectification(Pinhole{500, 500, 320, 240, 640, 480});
  EXPECT_TRUE(rectification.maps({0.01}).missing.empty()) << "border pixels are repeated";
  EXPECT_TRUE(rectification.maps({0, 0, -0.2}).missing.empty());
  const RectificationMaps maps = rectification.maps({0, 0, 0.25});
  const auto at = [&](int u, int v) { return maps.missing.at(size_t(v) * 640 + size_t(u)); };
  EXPECT_EQ(at(60, 240), 255);
  EXPECT_EQ(at(68, 240), 0);
  EXPECT_NEAR(maps.x.at(240 * 640 + 400), 320 + 1.25 * 80, 1e-4);
}

}  // namespace
}  // namespace edgevo
