// SPDX-License-Identifier: BSD-3-Clause
// Lasting edges are edges of the scene that a run found again: they lie on true edges, so moving shadows are
// not among them, and the same seed gives the same edges.
#include "lasting_edges.h"

#include <gtest/gtest.h>

#include <opencv2/imgproc.hpp>

#include "edgevo/simulation/scene_renderer.h"
#include "edgevo/simulation/true_edge_labels.h"

namespace edgevo::training {
namespace {

Scene beginning_of_desk() {
  Scene scene = load_scene("desk", 5);
  scene.camera.set_distortion({});
  scene.noise_sigma = 0;
  scene.T_scene_cam.resize(90);
  scene.times.resize(90);
  return scene;
}

cv::Mat copied(const GrayImage& image) {
  return cv::Mat(image.height, image.width, CV_8U, const_cast<uint8_t*>(image.pixels.data())).clone();
}

// Share of the pixels of `of` within two pixels of one of `to`.
double share_near(const cv::Mat& of, const cv::Mat& to) {
  cv::Mat wide;
  cv::dilate(to != 0, wide, cv::Mat::ones(5, 5, CV_8U));
  return double(cv::countNonZero((of != 0) & wide)) / cv::countNonZero(of);
}

class LastingEdges : public ::testing::Test {
 protected:
  static void SetUpTestSuite() { found_ = lasting_edges(beginning_of_desk(), 3); }
  static std::vector<LabelledFrame> found_;
};
std::vector<LabelledFrame> LastingEdges::found_;

TEST_F(LastingEdges, LieOnTrueEdges) {
  const SceneRenderer renderer(beginning_of_desk());
  ASSERT_GE(found_.size(), 4u);
  for (const LabelledFrame& f : found_) {
    const cv::Mat truth = copied(true_edge_labels(renderer, f.frame));
    if (cv::countNonZero(f.label) < 500) continue;  // at the ends of the run, seen from too few keyframes
    EXPECT_GT(share_near(f.label, truth), 0.9) << "frame " << f.frame;
    const cv::Mat elsewhere = copied(true_edge_labels(renderer, (f.frame + 45) % 90));
    EXPECT_GT(share_near(f.label, truth), share_near(f.label, elsewhere) + 0.1) << "frame " << f.frame;
  }
}

TEST_F(LastingEdges, AreNumerousInTheMiddleOfTheRun) {
  EXPECT_GT(cv::countNonZero(found_[found_.size() / 2].label), 2000);
}

TEST_F(LastingEdges, AreTheSameForTheSameSeed) {
  const std::vector<LabelledFrame> again = lasting_edges(beginning_of_desk(), 3);
  ASSERT_EQ(again.size(), found_.size());
  for (size_t i = 0; i < again.size(); ++i) {
    EXPECT_EQ(again[i].frame, found_[i].frame);
    EXPECT_EQ(cv::norm(again[i].label, found_[i].label, cv::NORM_INF), 0);
  }
}

}  // namespace
}  // namespace edgevo::training
