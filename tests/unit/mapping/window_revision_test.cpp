// SPDX-License-Identifier: BSD-3-Clause
// How a correction of the camera changes the window.
#include "edgevo/mapping/map_revision.h"

#include <gtest/gtest.h>

#include "window_scene.h"

namespace edgevo {
namespace {

using test::Sweep;
using test::true_window;

// A corner stays where the camera saw it, whatever is estimated about the lens.
TEST(Window, CornersMoveWithTheImagesWhenTheCameraIsCorrected) {
  Window window = true_window(2, 0.02);
  const Eigen::Vector3d from = Sweep::pinhole().ray({300, 20}), to = Sweep::pinhole().ray({15, 220});
  window.newest().corners_from = window.keyframes().front().id;
  window.newest().corners = {{from, to}};
  MapRevision revision;
  revision.now.k1 = 0.05;
  for (const Keyframe& k : window.keyframes()) {
    RevisedKeyframe r;
    r.id = k.id;
    r.T_cam_world = k.T_cam_world;
    r.length_ratio = 1;
    for (const MapPoint& p : k.points) r.points.push_back({p.px, p.idepth});
    revision.keyframes.push_back(r);
  }
  window.apply(revision, [](const Keyframe& k) { return k.pyramid; });
  const auto taken_at = [&](const ImageCorrection& c, const Eigen::Vector3d& ray) {
    return to_file(Sweep::pinhole(), c, ImageMotion(), ray.head<2>());
  };
  const CornerPair& moved = window.newest().corners.front();
  EXPECT_LT((taken_at(revision.now, moved.from) - taken_at(revision.before, from)).norm(), 1e-9);
  EXPECT_LT((taken_at(revision.now, moved.to) - taken_at(revision.before, to)).norm(), 1e-9);
  EXPECT_GT((moved.from - from).norm(), 1e-3);
}

// The information of keyframes that have left is linearised at poses before the correction: it is replaced
// with it.
TEST(Window, ACorrectionBringsItsOwnPrior) {
  Window window = true_window(5, 0.02);
  window.activate({2, 2});
  window.adjust();
  MapRevision revision;
  const int kept = int(window.keyframes().size());
  revision.prior.H =
      1e10 * Eigen::MatrixXd::Identity(6 * kept, 6 * kept);  // a tenth of a millimetre against all matches
  revision.prior.b = Eigen::VectorXd::Zero(6 * kept);
  for (const Keyframe& k : window.keyframes()) {
    // A quarter of a degree, which is three pixels at the border, and all edges contradict it.
    const SE3 turned = SE3(Eigen::Quaterniond(Eigen::AngleAxisd(0.004 * k.id, Eigen::Vector3d::UnitY())),
                           Eigen::Vector3d::Zero()) *
                       k.T_cam_world;
    RevisedKeyframe r;
    r.id = k.id;
    r.T_cam_world = turned;
    r.length_ratio = 1;
    for (const MapPoint& p : k.points) r.points.push_back({p.px, p.idepth});
    revision.keyframes.push_back(r);
    revision.prior.pose_ids.push_back(k.id);
    revision.prior.linearization.push_back(turned);
  }
  window.apply(revision, [](const Keyframe& k) { return k.pyramid; });
  window.adjust();
  for (size_t i = 0; i < window.keyframes().size(); ++i)
    EXPECT_LT((window.keyframes()[i].T_cam_world * revision.prior.linearization[i].inverse()).log().norm(),
              1e-4)
        << i;
}

}  // namespace
}  // namespace edgevo
