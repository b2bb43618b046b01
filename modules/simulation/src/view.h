// SPDX-License-Identifier: BSD-3-Clause
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

/// Near plane, metres; nothing nearer is drawn.
constexpr double kNear = 0.05;

/// A linear function of the image row: slope v + offset.
struct RowFunction {
  double slope, offset;
};

struct ViewSurface {
  /// N, with 1/z = N.d.
  Eigen::Vector3d idepth;
  /// Functions of the ray that are >= 0 on the surface; the last is the near plane.
  Eigen::Vector3d inside[5];
  /// `inside` solved for the image column u of a lens without distortion: at row v, u >= left(v), u <=
  /// right(v), and always(v) >= 0 if the column does not matter.
  RowFunction left[5], right[5], always[5];
  int left_count = 0, right_count = 0, always_count = 0;
  /// N in single precision, where exactness is not needed.
  Eigen::Vector3f idepth_f;
  /// Texture coordinates in texels of level 0, times 1/z.
  Eigen::Vector3f u, v;
  /// Distance of the surface's middle from the camera, metres.
  double distance = 0;
  /// Factor on the texture's gray.
  float gain = 1;
  /// Position on the ground over z as a function of the ray, from the point below the camera, scene axes;
  /// only of surfaces that take shadows.
  Eigen::Matrix<float, 2, 3> ground = Eigen::Matrix<float, 2, 3>::Zero();
  bool takes_shadows = false;
  const Surface* surface = nullptr;
  const Texture* texture = nullptr;
  /// Range of image rows that it may touch.
  int row_begin = 0, row_end = 0;
  /// Range of image columns that it may touch.
  int col_begin = 0, col_end = 0;
};

/// Rows begin <= v < end of an image.
struct RowRange {
  int begin, end;
};

/// Surfaces that may touch the rows, in the order of the world. A surface is described as for the whole
/// image, so that an image may be assembled from rows.
std::vector<ViewSurface> view_surfaces(const World& world, const Camera& camera, const SE3& T_scene_cam,
                                       RowRange rows);

/// The same through one face of the cube around the camera (lens_rays.h): rays are those of the face.
std::vector<ViewSurface> view_surfaces_in_face(const World& world, const Camera& camera, int face,
                                               const SE3& T_scene_cam, RowRange rows);

/// Pose of the axes of a face.
SE3 T_scene_face(const SE3& T_scene_cam, int face);

/// The cloud layer, a plane 1 km above the camera whatever its position.
ViewSurface view_sky(const World& world, const SE3& T_scene_cam);

}  // namespace edgevo
