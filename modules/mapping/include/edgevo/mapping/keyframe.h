#pragma once
// Keyframes and the edge points they host.
#include <Eigen/Core>
#include <algorithm>
#include <memory>
#include <vector>

#include "edgevo/association/associate.h"
#include "edgevo/core/se3.h"
#include "edgevo/core/timestamp.h"
#include "edgevo/edges/frame_pyramid.h"
#include "edgevo/mapping/corner_motion.h"

namespace edgevo {

/// A point's match in another keyframe of the window.
struct Observation {
  int keyframe_id = 0;  ///< that the point was matched in
  Match match;          ///< position, normal and weights there
};

/// An edge point with a depth good enough to track by and to adjust.
struct MapPoint {
  Eigen::Vector2d px;                     ///< in the host image, sub-pixel
  Eigen::Vector2d normal;                 ///< unit gradient in the host image
  double idepth = 0;                      ///< 1/z in the host frame
  double idepth_sigma = 0;                ///< one standard deviation, same unit
  int edge_pixel = -1;                    ///< index into the host's EdgeMap
  std::vector<Observation> observations;  ///< ascending keyframe_id
  int misses = 0;                         ///< keyframes that should have seen it and did not
  bool tentative = false;                 ///< its immature point lives on (Window::activate)

  /// Its match in a keyframe; null where there is none.
  const Observation* find(int keyframe_id) const {
    for (const Observation& o : observations)
      if (o.keyframe_id == keyframe_id) return &o;
    return nullptr;
  }
};

/// All its matches are ambiguous and hardly show its depth: the adjustment holds the depth, and they
/// constrain poses only.
inline bool is_depth_held(const MapPoint& p) {
  return std::all_of(p.observations.begin(), p.observations.end(),
                     [](const Observation& o) { return o.match.kind == MatchKind::kEdgeFixed; });
}

/// An edge point whose depth is still being found.
struct ImmaturePoint {
  Eigen::Vector2d px, normal;  ///< in the host image, sub-pixel; unit gradient there
  int edge_pixel = -1;         ///< index into the host's EdgeMap
  /// Until the first observation the middle and a quarter of the search range.
  double idepth = 0, idepth_sigma = 0;
  double idepth_guess = 0;  ///< from its surroundings, before any observation
  int good = 0, bad = 0;    ///< depth observations that agreed, and that did not
  int age = 0;              ///< keyframes since it was made
  bool tentative = false;   ///< until the next keyframe there is a MapPoint of it, too (Window::activate)
  bool dead = false;        ///< given up, or made a MapPoint: it goes
};

/// A keyframe with the points that it hosts.
struct Keyframe {
  int id = 0;                                   ///< ascending over the whole run
  int frame_index = 0;                          ///< in the source
  Timestamp time;                               ///< of its frame
  std::shared_ptr<const FramePyramid> pyramid;  ///< of its image; null once the images were dropped
  ImageMotion motion;                           ///< of the image when it was taken, for a rolling shutter
  SE3 T_cam_world;                              ///< of the segment's map
  std::vector<MapPoint> points;                 ///< in no particular order
  std::vector<ImmaturePoint> immature;          ///< ascending edge_pixel
  int corners_from = -1;            ///< keyframe that its corner matches start in; -1: it has none
  std::vector<CornerPair> corners;  ///< from there to here
};

/// Motion from keyframe `host` to keyframe `target`.
inline SE3 relative_pose(const Keyframe& target, const Keyframe& host) {
  return target.T_cam_world * host.T_cam_world.inverse();
}

}  // namespace edgevo
