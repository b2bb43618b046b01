// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A camera path from corners alone, in a unit of its own. Each corner has an inverse depth in the image that
// first showed it, filtered from the path itself; each image is placed by the corners of known depth,
// robustly. So the unit is carried from corner to corner, without the edges and their depths. The path
// drifts by some per cent in a hundred frames: too much for an odometry, little against a unit that is lost.
#include <optional>
#include <utility>
#include <vector>

#include "corner_sight.h"
#include "corner_tracks.h"
#include "edgevo/core/camera.h"
#include "edgevo/core/se3.h"

namespace edgevo {

/// What was found for one image.
struct ChainStep {
  /// Camera in the frame of the path, T_cam_path, in its unit.
  SE3 T_cam_path;
  /// Covariance of xi in T_cam_path <- exp(xi) T_cam_path given the corners' depths; large where the corners
  /// show no translation. Only if `is_measured`.
  Matrix6d covariance = Matrix6d::Zero();
  /// Whether the corners determined the pose; else the odometry's motion, or the one before, was adopted.
  bool is_measured = false;
  /// Number of corners that agree with the pose.
  int agreeing = 0;
  /// Median depth of the corners, unit of the path; 0: unknown.
  double median_depth = 0;
};

/// The path and the corners' depths.
class CornerChain {
 public:
  /// Where the corners are expected in the next image. `T_cur_last` as in add(): its rotation is better than
  /// that of the last step where a camera is held in the hand.
  std::vector<ExpectedCorner> expect(const std::optional<SE3>& T_cur_last) const;
  /// Places the next image. `T_cur_last` is the odometry's motion since the image before, in the unit of the
  /// path, if it is known: the first depths rest on it, afterwards it is only one of the starting points.
  ChainStep add(const CornerView& view, const std::optional<SE3>& T_cur_last);
  /// Adopts another lens (core/radial.h): the next image is rectified by it.
  void change_lens(const ImageCorrection& lens);
  /// Median inverse depth to expect before there are measured ones, unit of the path.
  void expect_idepth(double idepth) { first_idepth_ = idepth; }
  /// Corners that have contradicted the path repeatedly since the last call: not to be followed any more.
  std::vector<uint32_t> take_rejected() { return std::exchange(rejected_, {}); }

 private:
  struct Corner {
    uint32_t id = 0;
    Eigen::Vector3d ray;     // in the anchor, z = 1
    SE3 T_anchor_path;       // camera that saw the corner first
    double idepth = 0;       // in the anchor
    double information = 0;  // of idepth
    double best = 0;         // information of the best single measurement
    int misses = 0;          // images in a row that contradict it
    Eigen::Vector2d px;      // in the newest image
    double error = 0;        // whitened
  };
  struct Fit;  // normal equations at a pose

  void match(const std::vector<CornerTrack>& tracks);
  CornerSight predict(const Corner& corner, const SE3& T_cam_path) const;
  Fit linearise(const SE3& T_cam_path, double width) const;
  Fit fit(SE3 T_cam_path, const SE3& expected) const;
  ChainStep step_of(const std::optional<Fit>& found) const;
  std::optional<Fit> best_fit(const std::vector<SE3>& starts);
  void drop_outliers(double noise);
  void update_depths();
  void add_corners(const std::vector<CornerTrack>& tracks);
  static bool is_known(const Corner& corner);
  double idepth_around(const Eigen::Vector2d& px, double fallback) const;
  int known_depths() const;
  double median_idepth() const;

  Pinhole pinhole_;
  std::vector<Corner> corners_;  // by ascending id
  SE3 T_cam_path_;
  SE3 velocity_;  // T_cur_last of the path
  ImageCorrection lens_;
  double first_idepth_ = 0.1;
  bool is_running_ = false;
  int failures_ = 0;  // images in a row that were not placed
  std::vector<uint32_t> rejected_;
};

}  // namespace edgevo
