// SPDX-License-Identifier: BSD-3-Clause
#include "motion_of_essential.h"

#include <gtest/gtest.h>

#include <opencv2/calib3d.hpp>

#include "edgevo/core/random.h"
#include "edgevo/opencv_bridge/opencv_pose.h"
#include "support/twist.h"

namespace edgevo {
namespace {

const Pinhole kPinhole{500, 500, 320, 240, 640, 480};

// Pixels of points in front of two cameras; a tenth are wrong.
void look(const SE3& T_last_first, double nearest, double farthest, Random* random,
          std::vector<cv::Point2f>* first, std::vector<cv::Point2f>* last) {
  while (first->size() < 200) {
    const Eigen::Vector2d px(random->uniform(10, 630), random->uniform(10, 470));
    const Eigen::Vector3d p = T_last_first * (random->uniform(nearest, farthest) * kPinhole.ray(px));
    if (p.z() < 0.1) continue;
    Eigen::Vector2d to = kPinhole.project(p) + 0.3 * Eigen::Vector2d(random->normal(), random->normal());
    if (random->below(10) == 0) to += Eigen::Vector2d(random->uniform(-40, 40), random->uniform(-40, 40));
    first->emplace_back(float(px.x()), float(px.y()));
    last->emplace_back(float(to.x()), float(to.y()));
  }
}

// From near points to ones beyond what counts, in all directions of motion.
TEST(MotionOfEssential, IsThatOfRecoverPose) {
  Random random(5);
  int runs = 0;
  for (const double farthest : {4.0, 20.0, 45.0, 90.0, 400.0})
    for (int k = 0; k < 20; ++k) {
      const Eigen::Vector3d t =
          Eigen::Vector3d(random.normal(), random.normal(), random.normal()).normalized();
      const SE3 T(SE3::exp(test::twist(0, 0, 0, 0.1 * random.normal(), 0.1 * random.normal(), 0)).rotation(),
                  t);
      std::vector<cv::Point2f> first, last;
      look(T, 0.5 * farthest, farthest, &random, &first, &last);
      const cv::Mat K = camera_matrix(kPinhole);
      cv::Mat inliers;
      const cv::Mat E = cv::findEssentialMat(first, last, K, cv::RANSAC, 0.999, 1.0, inliers);
      if (E.rows != 3) continue;
      ++runs;
      cv::Mat R, R_cv, t_here, t_cv, kept = inliers.clone(), kept_cv = inliers.clone();
      motion_of_essential(E, first, last, K, &R, &t_here, &kept);
      cv::recoverPose(E, first, last, K, R_cv, t_cv, kept_cv);
      EXPECT_EQ(cv::norm(R, R_cv), 0) << farthest;
      EXPECT_EQ(cv::norm(t_here, t_cv), 0) << farthest;
      EXPECT_EQ(cv::countNonZero(kept), cv::countNonZero(kept_cv));
      EXPECT_EQ(cv::countNonZero((kept > 0) != (kept_cv > 0)), 0) << farthest;
    }
  EXPECT_GT(runs, 60);
}

}  // namespace
}  // namespace edgevo
