// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/features/view_fit.h"

#include <gtest/gtest.h>

#include "edgevo/features/two_view_motion.h"

namespace edgevo {
namespace {

// Corners of a plane, seen by a camera that turns and moves on a curve.
struct PlaneInView {
  Pinhole pinhole{500, 500, 320, 240, 640, 480};
  std::vector<SE3> T_cam_first;
  std::vector<Corners> views;

  explicit PlaneInView(double noise_px) {
    for (int v = 0; v < 6; ++v) {
      Vector6d xi;
      xi << 0.06 * v, 0.004 * v * v, 0.03 * v, 0.003 * v, 0.002 * v * v, 0;
      T_cam_first.push_back(SE3::exp(xi));
    }
    const Eigen::Vector3d normal = Eigen::Vector3d(0.1, 0.6, 1).normalized();
    views.resize(T_cam_first.size());
    Random random(4);
    while (views.front().size() < 200) {
      const Eigen::Vector2d px(random.uniform(40, 600), random.uniform(40, 440));
      const Eigen::Vector3d p = pinhole.ray(px) * (4 / normal.dot(pinhole.ray(px)));
      for (size_t v = 0; v < views.size(); ++v) {
        const Eigen::Vector2d q = pinhole.project(T_cam_first[v] * p) +
                                  (v > 0 ? noise_px : 0) * Eigen::Vector2d(random.normal(), random.normal());
        views[v].emplace_back(float(q.x()), float(q.y()));
      }
    }
  }
  SE3 truth() const { return T_cam_first.back(); }
  bool is_right(const SE3& T) const {
    return (T * truth().inverse()).angle() < 0.01 &&
           angle_between(T.translation(), truth().translation()) < 0.1;
  }
};

// Which of the motions is right is known from the views between alone.
TEST(EstimateMotionsOfPlane, BothMotionsFitTwoViews) {
  const PlaneInView plane(0);
  const auto motions = estimate_motions_of_plane(plane.pinhole, plane.views.front(), plane.views.back(), 0.7);
  ASSERT_EQ(motions.size(), 2u);
  for (const TwoViewMotion& m : motions) EXPECT_LT(m.median_error_px, 0.01);
  EXPECT_NE(plane.is_right(motions[0].T_last_first), plane.is_right(motions[1].T_last_first));
}

TEST(FitViews, TheViewsBetweenRefuteTheWrongMotionOfAPlane) {
  const PlaneInView plane(0.3);
  const auto motions = estimate_motions_of_plane(plane.pinhole, plane.views.front(), plane.views.back(), 0.7);
  ASSERT_EQ(motions.size(), 2u);
  const bool first_is_right = plane.is_right(motions[0].T_last_first);
  const auto right = fit_views(plane.pinhole, plane.views, motions[first_is_right ? 0 : 1].T_last_first);
  const auto wrong = fit_views(plane.pinhole, plane.views, motions[first_is_right ? 1 : 0].T_last_first);
  ASSERT_TRUE(right && wrong);
  EXPECT_TRUE(plane.is_right(right->T_last_first));
  EXPECT_LT(1.1 * right->error_px, wrong->error_px);
}

TEST(FitViews, TheErrorIsThatOfTheCorners) {
  const PlaneInView plane(0.3);
  const auto fit = fit_views(plane.pinhole, plane.views, plane.truth());
  ASSERT_TRUE(fit);
  EXPECT_NEAR(fit->error_px, 0.3 * std::sqrt(2), 0.05);
  EXPECT_NEAR(fit->T_last_first.translation().norm(), 1, 1e-9);
}

TEST(FitViews, AnOutlierSaysNoMoreThanTwoPixels) {
  PlaneInView plane(0);
  for (size_t v = 1; v < plane.views.size(); ++v) plane.views[v][7].x += 100;
  const auto fit = fit_views(plane.pinhole, plane.views, plane.truth());
  ASSERT_TRUE(fit);
  EXPECT_LT(fit->error_px, 0.25);  // 2 px of one in 200, and what the others give way
}

}  // namespace
}  // namespace edgevo
