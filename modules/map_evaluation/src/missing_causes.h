// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Why edges are missing in a map, as far as the scene says.
#include <vector>

#include "compared_frame.h"

namespace edgevo {

/// An edge pixel that no line explains.
struct MissingEdge {
  MissingEdge(const TrueEdgePixel& edge, const SE3& T_scene_cam, const Pinhole& pinhole, double depth_share);

  /// Scene axes, metres: the point, one next to it on the edge, and where it would be if it were farther from
  /// its frame by the share that makes a depth wrong.
  Eigen::Vector3d at, next, farther;
  /// From its frame, metres.
  double depth;
  Thing thing;
  bool is_short;
  /// Whether a line along it has another depth.
  bool is_misplaced = false;
  /// Frames that see it, and how far a wrong depth moves it in one of them, pixels: at most, and across the
  /// edge.
  int frames = 0;
  double moved_px = 0, across_px = 0;
};

/// Counts what the frames begin <= index < end see of the edges. Cost: a rendering of depth a frame.
void look_from_all_frames(const SceneRenderer& scene, int begin, int end, double depth_share,
                          std::vector<MissingEdge>* edges);

/// The first cause that holds, in the order of MissingCause.
MissingCause cause_of(const MissingEdge& edge);

}  // namespace edgevo
