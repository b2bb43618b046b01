// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The motion of a group of edge pixels in the image plane, found without map and depths, and how it compares
// with what a scene that stands still can do.
#include <Eigen/Core>
#include <vector>

#include "edgevo/core/camera.h"
#include "edgevo/core/se3.h"
#include "edgevo/edges/frame_pyramid.h"

namespace edgevo {

/// Motion in the image plane: px -> centre + shift + scale (px - centre).
struct ImageSimilarity {
  /// Fixed point of the change of size, pixels of the finest level.
  Eigen::Vector2d centre = Eigen::Vector2d::Zero();
  /// Pixels.
  Eigen::Vector2d shift = Eigen::Vector2d::Zero();
  /// Size after over size before, > 0.
  double scale = 1;

  /// Where a pixel moves.
  Eigen::Vector2d operator()(const Eigen::Vector2d& px) const {
    return centre + shift + scale * (px - centre);
  }
};

/// One motion after another.
ImageSimilarity then(const ImageSimilarity& first, const ImageSimilarity& second);

/// Edge pixel of an earlier image.
struct OrientedPixel {
  /// Position on the finest level, pixels.
  Eigen::Vector2d px;
  /// Unit gradient.
  Eigen::Vector2f normal;
};

/// Share of the edges next to a group from which on they have its motion.
constexpr double kSharesMotion = 0.65;

/// Every so many-th of the pixels, `most` of them; all, if there are fewer.
std::vector<OrientedPixel> thinned(const std::vector<OrientedPixel>& pixels, size_t most);

/// The motion of a group, and how many of its pixels lie on an edge of their direction then.
struct GroupMotion {
  /// From the earlier image to this one.
  ImageSimilarity motion;
  /// Share of the pixels within a pixel of such an edge, 0 to 1.
  double share = 0;
  /// The same for displaced copies of the group: what texture alone gives.
  double chance = 0;
};

/// Share of the pixels that a motion puts within a pixel of an edge of their direction, 0 to 1.
double agreeing_share(const PyramidLevel& finest, const std::vector<OrientedPixel>& group,
                      const ImageSimilarity& motion);

/// The edge pixels of an image on which a motion puts pixels of a group: what agreeing_share() counts.
std::vector<OrientedPixel> moved_edges(const PyramidLevel& finest, const std::vector<OrientedPixel>& group,
                                       const ImageSimilarity& motion);

/// Aligns a group with an image by iterated closest points from each of `starts`, and returns the motion with
/// the largest share. Finds changes of size by a tenth and shifts of 10 px from a start. Uses 120 of the
/// pixels. Cost: 0.1 ms a start.
GroupMotion align_group(const FramePyramid& current, const std::vector<OrientedPixel>& group,
                        const std::vector<ImageSimilarity>& starts);

/// A group's motion next to what stands still, seen by a camera that moves.
struct StaticComparison {
  /// Median distance of the group's pixels from where anything that stands still could be, at any depth from
  /// a tenth of the median to infinity, pixels.
  double distance_px = 0;
  /// Median distance in the image of that place from infinity, pixels: its parallax, if it stands still.
  double own_parallax_px = 0;
  /// Median distance in the image between points at the median depth and at infinity in the group's place,
  /// pixels.
  double parallax_px = 0;
  /// Whether the group keeps its place and size in the image.
  bool is_fixed = false;
};

/// Compares a group's motion with a camera that moves by T_cur_ref. `median_idepth` is that of the scene in
/// the reference.
StaticComparison compare_with_static(const Pinhole& camera, const SE3& T_cur_ref, double median_idepth,
                                     const std::vector<OrientedPixel>& group, const ImageSimilarity& motion);

}  // namespace edgevo
