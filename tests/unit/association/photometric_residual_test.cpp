#include "edgevo/association/photometric_residual.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>

#include "edgevo/edges/gradient.h"
#include "support/plane_scene.h"
#include "support/test_images.h"

namespace edgevo {
namespace {

TEST(PhotometricResidual, FindsTheShiftAndItsInformation) {
  const test::Texture texture(23);
  const auto magnitude = [&](const Eigen::Vector2d& shift, double gain) {
    const GrayImage image = test::make_image(
        100, 80, [&](double x, double y) { return gain * texture.at(Eigen::Vector2d(x, y) - shift) + 10; });
    return compute_gradient(image.view()).magnitude;
  };
  const Plane<float> host = magnitude({0, 0}, 1);
  int usable = 0;
  double square = 0;
  for (const Eigen::Vector2d& shift :
       {Eigen::Vector2d(0.3, -0.2), Eigen::Vector2d(-0.25, 0.3), Eigen::Vector2d(0, 0)}) {
    const Plane<float> target = magnitude(shift, 0.6);
    for (double x = 20; x < 80; x += 7)
      for (double y = 20; y < 60; y += 7) {
        const PhotometricResidual r =
            photometric_residual(host.view(), {x, y}, Eigen::Matrix2d::Identity(), target.view(), {x, y});
        if (!r.usable || r.information.eigenvalues().real().minCoeff() < 0.1)
          continue;  // not well observed both ways
        ++usable;
        square += (r.shift - shift).squaredNorm();
        EXPECT_LT((r.shift - shift).norm(), 0.5) << x << " " << y;
        // Information is the second derivative of half the mean square along each axis, at the match.
        const auto half_square = [&](double dx, double dy) {
          return 0.5 * photometric_residual(host.view(), {x, y}, Eigen::Matrix2d::Identity(), host.view(),
                                            {x + dx, y + dy})
                           .mean_square;
        };
        constexpr double kStep = 0.2;
        const double xx = (half_square(kStep, 0) + half_square(-kStep, 0)) / (kStep * kStep);
        EXPECT_GT(xx / r.information(0, 0), 0.5);
        EXPECT_LT(xx / r.information(0, 0),
                  2.0);  // bilinear sampling between pixels blurs, which adds to the difference
      }
  }
  EXPECT_GT(usable, 10);
  EXPECT_LT(std::sqrt(square / usable), 0.15);
}

TEST(PhotometricResidual, RefusesFlatAndUnrelatedPatches) {
  const Plane<float> a = compute_gradient(test::textured_image(100, 80, 17).view()).magnitude;
  const GrayImage flat{100, 80, std::vector<uint8_t>(8000, 77)};
  const Plane<float> b = compute_gradient(flat.view()).magnitude;
  const Eigen::Matrix2d I = Eigen::Matrix2d::Identity();
  EXPECT_FALSE(photometric_residual(b.view(), {50, 40}, I, a.view(), {50, 40}).usable);
  EXPECT_FALSE(photometric_residual(a.view(), {50, 40}, I, b.view(), {50, 40}).usable);
  EXPECT_FALSE(photometric_residual(a.view(), {1, 40}, I, a.view(), {50, 40}).usable);
}

}  // namespace
}  // namespace edgevo
