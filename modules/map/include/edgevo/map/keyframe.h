// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Keyframes and the edge points they host.
#include <Eigen/Core>
#include <algorithm>
#include <memory>
#include <optional>
#include <vector>

#include "edgevo/association/associate.h"
#include "edgevo/core/se3.h"
#include "edgevo/core/timestamp.h"
#include "edgevo/edges/frame_pyramid.h"
#include "edgevo/edges/image_motion.h"

namespace edgevo {

/// A point's match in another keyframe of the window.
struct Observation {
  /// Keyframe that the point was matched in.
  int keyframe_id = 0;
  /// Position, normal and weights of the match.
  Match match;
};

/// An edge point whose depth is good enough to track against and to adjust.
struct MapPoint {
  /// Pixel in the host image, sub-pixel.
  Eigen::Vector2d px;
  /// Unit gradient in the host image.
  Eigen::Vector2d normal;
  /// Inverse depth 1/z in the host frame.
  double idepth = 0;
  /// Standard deviation of `idepth`.
  double idepth_sigma = 0;
  /// Index into the host's ImageEdges.
  int edge_pixel = -1;
  /// Matches, ascending keyframe_id.
  std::vector<Observation> observations;
  /// Number of keyframes that should have seen the point and did not.
  int misses = 0;
  /// True while its immature point lives on (Window::activate).
  bool tentative = false;
  /// Inverse depth that an earlier host has passed on, and its standard deviation (Window::remove_oldest); 0:
  /// none.
  double known_idepth = 0, known_sigma = 0;

  /// The match in a keyframe; null if there is none.
  const Observation* find(int keyframe_id) const {
    for (const Observation& o : observations)
      if (o.keyframe_id == keyframe_id) return &o;
    return nullptr;
  }
};

/// True if all matches are ambiguous and hardly constrain the depth: the adjustment fixes the depth, and the
/// matches constrain poses only.
inline bool is_depth_fixed(const MapPoint& p) {
  return std::all_of(p.observations.begin(), p.observations.end(),
                     [](const Observation& o) { return o.match.kind == MatchKind::kEdgeFixed; });
}

/// An edge point whose depth is still being found.
struct ImmaturePoint {
  /// Pixel in the host image, sub-pixel, and unit gradient there.
  Eigen::Vector2d px, normal;
  /// Index into the host's ImageEdges.
  int edge_pixel = -1;
  /// Inverse depth and its standard deviation; the middle and a quarter of the search range before any
  /// observation.
  double idepth = 0, idepth_sigma = 0;
  /// Inverse depth guessed from the surroundings, before any observation.
  double idepth_guess = 0;
  /// Number of depth observations that agreed, and that did not.
  int good = 0, bad = 0;
  /// Number of keyframes since the point was made.
  int age = 0;
  /// True if a MapPoint of it exists, too, until the next keyframe (Window::activate).
  bool tentative = false;
  /// True if the point was given up or made a MapPoint, and is to be removed.
  bool dead = false;
};

/// A corner in two images.
struct CornerPair {
  /// Rays (x, y, 1) in the two cameras.
  Eigen::Vector3d from, to;
};

/// Rotation since an earlier keyframe that another sensor measured.
struct KeyframeTurn {
  /// Id of that keyframe.
  int from = -1;
  /// From its camera to this one.
  Eigen::Quaterniond R = Eigen::Quaterniond::Identity();
  /// Inverse of the covariance of w in R <- exp(w) R, rad^-2.
  Eigen::Matrix3d information = Eigen::Matrix3d::Zero();
};

/// A keyframe with the points that it hosts.
struct Keyframe {
  /// Id, ascending over the whole run.
  int id = 0;
  /// Index of the frame in the source.
  int frame_index = 0;
  /// Timestamp of the frame.
  Timestamp time;
  /// Edge pyramid; null once the images were dropped.
  std::shared_ptr<const FramePyramid> pyramid;
  /// Motion of the image when it was taken, for a rolling shutter.
  ImageMotion motion;
  /// Pose in the segment's map.
  SE3 T_cam_world;
  /// Whether the keyframe is provisional: made while the motion was in doubt, and not confirmed since.
  bool is_doubtful = false;
  /// Active points, in no particular order.
  std::vector<MapPoint> points;
  /// Immature points, ascending edge_pixel.
  std::vector<ImmaturePoint> immature;
  /// Keyframe that the corner matches start in; -1: there are none.
  int corners_from = -1;
  /// Corner matches from `corners_from` to this keyframe.
  std::vector<CornerPair> corners;
  /// Rotation by another sensor; nothing: none measured it.
  std::optional<KeyframeTurn> turn = std::nullopt;
};

/// Motion from keyframe `host` to keyframe `target`.
inline SE3 relative_pose(const Keyframe& target, const Keyframe& host) {
  return target.T_cam_world * host.T_cam_world.inverse();
}

}  // namespace edgevo
