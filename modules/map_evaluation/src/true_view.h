// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// What a rendered frame shows: its edges with their depth and kind.
#include <memory>
#include <vector>

#include "edgevo/edges/frame_pyramid.h"
#include "edgevo/simulation/scene_renderer.h"
#include "edgevo/simulation/true_edge_labels.h"

namespace edgevo {

/// An edge pixel that a plain Canny sees.
struct TrueEdgePixel {
  Eigen::Vector2d px, normal;
  /// Depth of the surface that it belongs to, metres.
  double depth = 0;
  TrueEdge kind = TrueEdge::none;
  Thing thing = Thing::kObject;
  /// A point next to it on the edge, axes of the camera, metres.
  Eigen::Vector3d next = Eigen::Vector3d::Zero();
  /// Length of its edge in the image, pixels.
  int length_px = 0;
  /// Whether it runs along its epipolar line, for the motion from the frame compared before.
  bool is_along_motion = false;
};

/// Where an edge is, as a robot meets it.
enum class EdgePlace {
  /// Close to the ground: markings, kerbs, the feet of things.
  kOnGround,
  /// Upright above it: poles, corners, frames of doors.
  kUpright,
  /// Neither: ledges, wires, roofs, leaves.
  kAbove
};

/// Edges of a frame, and the depth of what it shows.
class TrueView {
 public:
  /// `before`: index of the frame that the motion is measured from.
  TrueView(const SceneRenderer& scene, PyramidBuilder* builder, int index, int before);

  const Pinhole& pinhole() const { return pinhole_; }
  const SE3& T_scene_cam() const { return T_scene_cam_; }
  const GrayImage& image() const { return image_; }
  /// Edges not in the sky.
  const std::vector<TrueEdgePixel>& edges() const { return edges_; }

  /// Where an edge of this depth and this normal in the image is.
  EdgePlace place_of(const Eigen::Vector2d& px, const Eigen::Vector2d& normal, double depth) const;
  /// Whether a point at this depth is hidden at all pixels within `reach` of `px` by surfaces nearer than the
  /// share allows.
  bool is_hidden(const Eigen::Vector2d& px, double depth, double reach, double share) const;
  /// Whether an edge of that depth lies within `reach`: one that Canny sees, or one that the scene has there,
  /// however faint.
  bool has_edge(const Eigen::Vector2d& px, double depth, double reach, double share) const;

 private:
  void add_edges(const PyramidLevel& level, const SE3& T_before_cam);
  Thing thing_of(const TrueEdgePixel& edge) const;
  void add_faint_edges();

  Pinhole pinhole_;
  SE3 T_scene_cam_;
  GrayImage image_;
  std::vector<float> depth_;
  GrayImage labels_, things_;
  std::vector<TrueEdgePixel> edges_;
  /// Depth of the edge at each pixel, metres; 0: none.
  std::vector<float> edge_depth_;
};

}  // namespace edgevo
