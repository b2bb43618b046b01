// SPDX-License-Identifier: BSD-3-Clause
#include "lens_rays.h"

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <cmath>
#include <optional>

#include "visibility.h"

namespace edgevo {
namespace {

void add_front(const Camera& camera, const Eigen::Vector2d& px, LensRays* rays) {
  // Outside the lens model: a corner that no ray reaches.
  const Eigen::Vector3d ray = camera.unproject(px).value_or(camera.pinhole().ray(px));
  rays->xy.push_back(ray.hnormalized().cast<float>());
}

// The face whose normal is closest to the ray.
int face_of(const Eigen::Vector3d& ray) {
  int best = 0;
  for (int i = 1; i < kFaces; ++i)
    if (R_cam_face()[size_t(i)].col(2).dot(ray) > R_cam_face()[size_t(best)].col(2).dot(ray)) best = i;
  return best;
}

bool is_seen(const Eigen::Vector3d& ray, double max_angle) {
  return std::atan2(ray.head<2>().norm(), ray.z()) <= max_angle;
}

// The ray of a pixel next to one whose ray is known, by two steps of Newton's method: much faster than
// unproject(), which looks for the range of the lens.
std::optional<Eigen::Vector3d> ray_near(const Camera& camera, Eigen::Vector3d ray,
                                        const Eigen::Vector2d& px) {
  for (int i = 0; i < 2; ++i) {
    const auto at = camera.project(ray);
    if (!at) return std::nullopt;
    const PixelJacobian J = camera.jacobian(ray);
    ray += J.transpose() * (J * J.transpose()).ldlt().solve(px - *at);
  }
  return ray;
}

void add_to_face(const std::optional<Eigen::Vector3d>& ray, LensRays* rays) {
  const int face = ray ? face_of(*ray) : kNoFace;
  rays->face.push_back(uint8_t(face));
  Eigen::Vector2f xy(0, 0);
  if (ray) xy = (R_cam_face()[size_t(face)].transpose() * *ray).hnormalized().cast<float>();
  rays->xy.push_back(xy);
}

// The rays of a row through the faces, sample by sample.
void add_row_to_faces(const Camera& camera, double max_angle, int v, LensRays* rays) {
  std::vector<std::optional<Eigen::Vector3d>> centres;
  for (int u = 0; u < camera.width; ++u) {
    centres.push_back(camera.unproject({double(u), double(v)}));
    if (centres.back() && !is_seen(*centres.back(), max_angle)) centres.back().reset();
  }
  for (const Eigen::Vector2f& offset : sample_offsets())
    for (int u = 0; u < camera.width; ++u) {
      const auto& centre = centres[size_t(u)];
      add_to_face(centre ? ray_near(camera, *centre, Eigen::Vector2d(u, v) + offset.cast<double>()) : centre,
                  rays);
    }
}

void add_row_to_front(const Camera& camera, int v, LensRays* rays) {
  for (const Eigen::Vector2f& offset : sample_offsets())
    for (int u = 0; u < camera.width; ++u)
      add_front(camera, Eigen::Vector2d(u, v) + offset.cast<double>(), rays);
}

}  // namespace

const std::array<Eigen::Matrix3d, kFaces>& R_cam_face() {
  static const std::array<Eigen::Matrix3d, kFaces> rotations = [] {
    const auto turned = [](int axis, int quarters) {
      Eigen::Matrix3d R = Eigen::Matrix3d::Identity();
      const int a = (axis + 1) % 3, b = (axis + 2) % 3;
      const int cosine = quarters == 2 ? -1 : 0, sine = quarters == 2 ? 0 : quarters;
      R(a, a) = R(b, b) = cosine, R(b, a) = sine, R(a, b) = -sine;
      return R;
    };
    return std::array<Eigen::Matrix3d, kFaces>{
        Eigen::Matrix3d::Identity(), turned(1, 1), turned(1, -1), turned(0, -1), turned(0, 1), turned(1, 2)};
  }();
  return rotations;
}

LensRays rays_through_lens(const Camera& camera) {
  LensRays rays;
  if (!camera.has_distortion()) return rays;
  const bool is_front = camera.plumb_bob().has_value();
  const double max_angle = camera.max_angle();
  rays.xy.reserve(size_t(camera.width) * camera.height * kSamples);
  for (int v = 0; v < camera.height; ++v)
    if (is_front)
      add_row_to_front(camera, v, &rays);
    else
      add_row_to_faces(camera, max_angle, v, &rays);
  return rays;
}

}  // namespace edgevo
