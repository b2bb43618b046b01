// SPDX-License-Identifier: BSD-3-Clause
// How a move of the map changes the window.
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <cmath>

#include "edgevo/edges/image_correction.h"
#include "window_scene.h"

namespace edgevo {
namespace {

using test::OwnWindow;
using test::Sweep;
using test::true_window;

std::shared_ptr<const FramePyramid> same_images(const Keyframe& k) { return k.pyramid; }

// A move that leaves each keyframe of the window where it is.
MapMoved no_move(const OwnWindow& window) {
  MapMoved moved;
  moved.segment = 0;
  moved.prior.emplace();
  for (const Keyframe& k : window.keyframes()) {
    KeyframeMove m;
    m.id = k.id;
    m.T_cam_newest = k.T_cam_world * window.newest().T_cam_world.inverse();
    for (const MapPoint& p : k.points) m.points.push_back({p.px, p.idepth});
    moved.keyframes.push_back(m);
  }
  return moved;
}

// A corner stays where the camera saw it, whatever is estimated about the lens.
TEST(Window, CornersMoveWithTheImagesWhenTheCameraIsCorrected) {
  OwnWindow window = true_window(2, 0.02);
  const Eigen::Vector3d from = Sweep::pinhole().ray({300, 20}), to = Sweep::pinhole().ray({15, 220});
  window.newest().corners_from = window.keyframes().front().id;
  window.newest().corners = {{from, to}};
  MapMoved moved = no_move(window);
  const ImageCorrection before, now{0.05, 0};
  moved.lens = LensChange{before, now};
  window.map->move(moved, same_images);
  const auto taken_at = [&](const ImageCorrection& c, const Eigen::Vector3d& ray) {
    return to_file(Sweep::pinhole(), c, ImageMotion(), ray.head<2>());
  };
  const CornerPair& corner = window.newest().corners.front();
  EXPECT_LT((taken_at(now, corner.from) - taken_at(before, from)).norm(), 1e-9);
  EXPECT_LT((taken_at(now, corner.to) - taken_at(before, to)).norm(), 1e-9);
  EXPECT_GT((corner.from - from).norm(), 1e-3);
}

// The information of marginalised keyframes is linearised at poses before the move: it is replaced with it.
TEST(Window, AMoveBringsItsOwnPrior) {
  OwnWindow window = true_window(5, 0.02);
  window.activate({2, 2});
  window.adjust();
  MapMoved moved = no_move(window);
  BaPrior& prior = *moved.prior;
  const int kept = int(window.keyframes().size());
  // A tenth of a millimetre against all matches.
  prior.H = 1e10 * Eigen::MatrixXd::Identity(6 * kept, 6 * kept);
  prior.b = Eigen::VectorXd::Zero(6 * kept);
  for (int i = 0; i < kept; ++i) {
    // A quarter of a degree, which is three pixels at the border, and all edges contradict it.
    const int to_newest = i + 1 - kept;
    const SE3 turned = SE3(Eigen::Quaterniond(Eigen::AngleAxisd(0.004 * to_newest, Eigen::Vector3d::UnitY())),
                           Eigen::Vector3d::Zero()) *
                       window.keyframes()[size_t(i)].T_cam_world;
    moved.keyframes[size_t(i)].T_cam_newest = turned * window.newest().T_cam_world.inverse();
    prior.pose_ids.push_back(window.keyframes()[size_t(i)].id);
    prior.linearization.push_back(turned);
  }
  window.map->move(moved, same_images);
  window.set_prior(prior);
  window.adjust();
  for (size_t i = 0; i < window.keyframes().size(); ++i)
    EXPECT_LT((window.keyframes()[i].T_cam_world * prior.linearization[i].inverse()).log().norm(), 1e-4) << i;
}

// Of the keyframes that it shares matches with, four at most.
TEST(Window, ALeavingKeyframeIsAnnouncedRelativeToItsNeighbours) {
  OwnWindow window = true_window(6, 0.02);
  MapCursor cursor(window.log);
  window.activate({2, 2});
  window.fix_bootstrap_scale();
  window.adjust();
  const std::deque<Keyframe> before = window.keyframes();
  window.remove_oldest();
  const auto events = cursor.read();
  const auto* left = std::get_if<KeyframeMarginalised>(events.back().get());
  ASSERT_TRUE(left);
  EXPECT_EQ(left->id, 0);
  ASSERT_EQ(left->neighbours.size(), 4u);
  int last = 0;
  for (const NeighbourPose& n : left->neighbours) {
    EXPECT_GT(n.id, last);
    last = n.id;
    const SE3 expected = relative_pose(before.front(), before[size_t(n.id)]);
    EXPECT_LT((n.T_leaving_neighbour * expected.inverse()).log().norm(), 1e-12);
    const Eigen::SelfAdjointEigenSolver<Matrix6d> eigen(n.covariance);
    EXPECT_GT(eigen.eigenvalues().minCoeff(), 0);
    // From the matches of the leaving keyframe's points alone: 0.2 and 0.08.
    EXPECT_LT(std::sqrt(n.covariance.topLeftCorner<3, 3>().trace()), 0.3);
    EXPECT_LT(std::sqrt(n.covariance.bottomRightCorner<3, 3>().trace()), 0.15);
  }
}

TEST(Window, AtTheEndOfASegmentTheCovarianceIsUnknown) {
  OwnWindow window = true_window(3, 0.02);
  MapCursor cursor(window.log);
  window.activate({2, 2});
  window.adjust();
  window.release_oldest();
  const auto events = cursor.read();
  const auto& left = std::get<KeyframeMarginalised>(*events.back());
  ASSERT_EQ(left.neighbours.size(), 2u);
  for (const NeighbourPose& n : left.neighbours) EXPECT_TRUE(n.covariance.isZero(0));
}

}  // namespace
}  // namespace edgevo
