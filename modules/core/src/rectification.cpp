// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/core/rectification.h"

#include <cmath>
#include <limits>

#include "edgevo/core/error.h"
#include "edgevo/core/radial.h"
#include "edgevo/core/target_pinhole.h"

namespace edgevo {
namespace {

constexpr uint8_t kMissing = 255;

// Largest radius of normalised coordinates that the lens shows.
double max_tangent(const Camera& camera) {
  const double angle = camera.max_angle();
  return angle < M_PI / 2 ? std::tan(angle) : std::numeric_limits<double>::infinity();
}

}  // namespace

Rectification::Rectification(const Camera& camera)
    : camera_(camera), target_(target_pinhole(camera)), masks_outside_(!camera.plumb_bob()) {}

Rectification::Rectification(const Camera& camera, const Pinhole& target)
    : camera_(camera), target_(target), masks_outside_(true) {}

Eigen::Vector2d Rectification::raw_pixel(const Eigen::Vector2d& x_file) const {
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  return camera_.project({x_file.x(), x_file.y(), 1}).value_or(Eigen::Vector2d(kNone, kNone));
}

// The area of a pixel reaches half a pixel beyond its centre. NaN is outside.
bool Rectification::is_outside(const Eigen::Vector2d& raw) const {
  return !(raw.x() >= -0.5 && raw.y() >= -0.5 && raw.x() <= camera_.width - 0.5 &&
           raw.y() <= camera_.height - 0.5);
}

RectificationMaps Rectification::maps(const ImageCorrection& lens) const {
  RectificationMaps maps{target_.width, target_.height, {}, {}, {}};
  const size_t size = size_t(target_.width) * target_.height;
  maps.x.reserve(size);
  maps.y.reserve(size);
  const double largest = max_tangent(camera_);
  const bool masks_outside = masks_outside_ || lens.focal != 0;
  for (int v = 0; v < target_.height; ++v)
    for (int u = 0; u < target_.width; ++u) {
      const Eigen::Vector2d x_file = add_lens(lens, target_.ray({double(u), double(v)}).head<2>());
      const Eigen::Vector2d raw = raw_pixel(x_file);
      if (!(x_file.norm() <= largest) || (masks_outside && is_outside(raw))) {
        maps.missing.resize(size);
        maps.missing[maps.x.size()] = kMissing;
      }
      maps.x.push_back(float(raw.x()));
      maps.y.push_back(float(raw.y()));
    }
  return maps;
}

void Rectification::check(const std::string& where) const {
  camera_.check(where);
  if (!masks_outside_) return;
  Camera(target_).check(where + ", rectified");
  if (camera_.width < 2 || camera_.height < 2)
    throw InputError(where, "images of one row or column cannot be rectified to another camera",
                     "leave the camera as it is");
}

}  // namespace edgevo
