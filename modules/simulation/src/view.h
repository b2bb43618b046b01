#pragma once
// The surfaces of a world as one camera pose sees them: linear functions of the viewing ray.
//
// For the surface p = origin + a side_u + b side_v in the camera frame and a ray d = (x, y, 1), the depth z,
// a and b follow
//     1/z = N.d        a/z = A.d        b/z = B.d
// with constant vectors N, A, B; so do the texture coordinates over z. A point is on the surface where a and
// b lie in [0, 1], that is where A.d, (N-A).d, B.d and (N-B).d are not negative.
#include <Eigen/Core>
#include <vector>

#include "edgevo/core/camera.h"
#include "edgevo/core/se3.h"
#include "edgevo/simulation/world.h"

namespace edgevo {

constexpr double kNear = 0.05;  ///< metres; nothing nearer is drawn

/// A linear function of the image row: slope v + offset.
struct RowFunction {
  double slope, offset;
};

struct ViewSurface {
  Eigen::Vector3d idepth;     ///< N: 1/z = N.d
  Eigen::Vector3d inside[5];  ///< >= 0 on the surface; the last holds the near plane
  /// `inside` solved for the image column u of a lens without distortion: at row v, u >= left(v), u <=
  /// right(v); and where the column does not matter, always(v) >= 0.
  RowFunction left[5], right[5], always[5];
  int left_count = 0, right_count = 0, always_count = 0;
  Eigen::Vector3f idepth_f;  ///< N again, for what need not be exact
  Eigen::Vector3f u, v;      ///< texels of level 0, times 1/z
  double distance = 0;       ///< of its middle from the camera, metres
  const Surface* surface = nullptr;
  const Texture* texture = nullptr;
  int row_begin = 0, row_end = 0;  ///< image rows that it may touch
  int col_begin = 0, col_end = 0;  ///< image columns that it may touch
};

/// Rows begin <= v < end of an image.
struct RowRange {
  int begin, end;
};

/// Surfaces that may touch the rows, in the order of the world's. A surface is described as the whole image
/// sees it, whatever the rows, so that an image may be put together from rows.
std::vector<ViewSurface> view_surfaces(const World& world, const Camera& camera, const SE3& T_scene_cam,
                                       RowRange rows);

/// The cloud layer, a plane 1 km above the camera whatever its position.
ViewSurface view_sky(const World& world, const SE3& T_scene_cam);

}  // namespace edgevo
