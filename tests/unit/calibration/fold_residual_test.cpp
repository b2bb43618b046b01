// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/calibration/fold_residual.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <opencv2/calib3d.hpp>

#include "edgevo/core/error.h"
#include "edgevo/core/radial.h"

namespace edgevo {
namespace {

// TUM RGB-D, freiburg1: a strong lens.
Camera tum_fr1() {
  Camera camera;
  camera.set_pinhole({517.3, 516.5, 318.6, 255.3, 640, 480});
  camera.set_distortion({0.2624, -0.9531, -0.0054, 0.0026, 1.1633});
  return camera;
}

// Projection of a ray by OpenCV, which has no residual distortion.
cv::Point2d seen_by_opencv(const Camera& camera, const Eigen::Vector2d& x) {
  const Pinhole p = camera.pinhole();
  const Distortion d = camera.distortion();
  std::vector<cv::Point2d> px;
  cv::projectPoints(std::vector<cv::Point3d>{{x.x(), x.y(), 1}}, cv::Vec3d(0, 0, 0), cv::Vec3d(0, 0, 0),
                    cv::Matx33d(p.fx, 0, p.cx, 0, p.fy, p.cy, 0, 0, 1),
                    std::vector<double>{d.k1, d.k2, d.p1, d.p2, d.k3}, px);
  return px[0];
}

// Largest distance, over the pixels of the image, between a camera with the residual and the
// folded one in OpenCV's model.
double largest_error(const Camera& truth, const ImageCorrection& residual, const Camera& folded) {
  double largest = 0;
  for (int v = 0; v < truth.height; v += 7)
    for (int u = 0; u < truth.width; u += 7) {
      const auto ray = truth.unproject({double(u), double(v)});
      EXPECT_TRUE(ray);
      const cv::Point2d seen = seen_by_opencv(folded, remove_lens(residual, ray->head<2>() / ray->z()));
      largest = std::max(largest, std::hypot(seen.x - u, seen.y - v));
    }
  return largest;
}

TEST(FoldResidual, LeavesAThirtiethOfTheShiftOfAStrongLens) {
  for (const double k1 : {0.01, -0.01, 0.03}) {
    const FoldedCamera folded = fold_residual(tum_fr1(), {k1}, "here");
    std::cout << "[ figures  ] k1 " << k1 << ": rms " << folded.rms_error_px << ", largest "
              << folded.max_error_px << ", shift " << folded.max_shift_px << " px\n";
    EXPECT_LT(folded.rms_error_px, 1.5 * std::abs(k1));
    EXPECT_LT(folded.max_error_px, folded.max_shift_px / 25);
    EXPECT_NEAR(largest_error(tum_fr1(), {k1}, folded.camera), folded.max_error_px,
                0.1 * folded.max_error_px);
  }
}

TEST(FoldResidual, IsExactForAFileWithoutDistortion) {
  Camera camera;
  camera.set_pinhole({718.856, 718.856, 607.1928, 185.2157, 1241, 376});
  const FoldedCamera folded = fold_residual(camera, {0.012}, "here");
  EXPECT_EQ(folded.camera.distortion().k1, 0.012);
  EXPECT_EQ(folded.camera.distortion().k2, 0);
  EXPECT_EQ(folded.max_error_px, 0);
  // The corner is furthest from the principal point: x = (633/718.9, 190/718.9), moved by f k1 r^3, that
  // is 6.8 px in x.
  EXPECT_NEAR(folded.max_shift_px, 6.6, 0.4);
}

TEST(FoldResidual, AnotherFocalLengthGoesIntoThePinhole) {
  Camera camera;
  camera.set_pinhole({500, 510, 320, 240, 640, 480});
  const FoldedCamera plain = fold_residual(camera, {0.01, 0, 0.2}, "here");
  EXPECT_NEAR(plain.camera.pinhole().fx, 600, 1e-9);
  EXPECT_NEAR(plain.camera.pinhole().fy, 612, 1e-9);
  EXPECT_EQ(plain.camera.pinhole().cx, 320);
  EXPECT_EQ(plain.camera.distortion().k1, 0.01);
  EXPECT_LT(plain.max_error_px, 1e-9);
  const FoldedCamera strong = fold_residual(tum_fr1(), {0, 0, 0.1}, "here");
  EXPECT_LT(strong.max_error_px, 1e-6);
  EXPECT_LT(largest_error(tum_fr1(), {0, 0, 0.1}, strong.camera), 1e-6);
}

TEST(FoldResidual, WithoutResidualNothingChanges) {
  const FoldedCamera folded = fold_residual(tum_fr1(), {}, "here");
  EXPECT_EQ(folded.camera.distortion().k1, 0.2624);
  EXPECT_EQ(folded.camera.distortion().k3, 1.1633);
  EXPECT_EQ(folded.max_error_px, 0);
  EXPECT_EQ(folded.max_shift_px, 0);
}

TEST(FoldResidual, ANarrowLensKeepsModestCoefficients) {
  Camera camera;
  camera.set_pinhole({5000, 5000, 320, 240, 640, 480});  // 7 degrees wide: k2 and k3 move nothing
  camera.set_distortion({-0.1, 0, 0, 0, 0});
  const FoldedCamera folded = fold_residual(camera, {0.01}, "here");
  EXPECT_LT(folded.max_error_px, 1e-4);
  EXPECT_LT(std::abs(folded.camera.distortion().k2) + std::abs(folded.camera.distortion().k3), 1.0);
}

TEST(FoldResidual, ALensThatFoldsOverIsRefused) {
  Camera camera = tum_fr1();
  camera.set_distortion({-8, 0, 0, 0, 0});
  try {
    (void)fold_residual(camera, {0.01}, "here");
    FAIL() << "no InputError";
  } catch (const InputError& e) {
    EXPECT_THAT(e.what(), ::testing::HasSubstr("here: the lens model cannot be inverted"));
  }
}

}  // namespace
}  // namespace edgevo
