// SPDX-License-Identifier: BSD-3-Clause
#include "camera_change.h"

namespace edgevo {
namespace {

// The distortion in axes turned clockwise, x' = -y, y' = x: the new right is the old up. What depends on the
// radius only stays as it is.
void turn(Distortion* d) {
  const double p1 = d->p1;
  d->p1 = d->p2, d->p2 = -p1;
}

void turn_lens(PlumbBobModel* m) { turn(&m->distortion); }
void turn_lens(OmniModel* m) { turn(&m->distortion); }
void turn_lens(RationalModel* m) {
  RationalDistortion& d = m->distortion;
  turn(&d.plumb_bob);
  const double s1 = d.s1, s2 = d.s2;
  d.s1 = -d.s3, d.s2 = -d.s4;
  d.s3 = s1, d.s4 = s2;
}
template <class RadialModel>
void turn_lens(RadialModel* /*model*/) {}

Camera turned_clockwise(const Camera& camera) {
  const Pinhole p = camera.pinhole();
  Camera turned = camera;
  std::visit([](auto& m) { turn_lens(&m); }, turned.model);
  turned.set_pinhole({p.fy, p.fx, p.height - 1 - p.cy, p.cx, p.height, p.width});
  return turned;
}

}  // namespace

Camera scaled_camera(const Camera& camera, int width, int height) {
  const Pinhole p = camera.pinhole();
  const double x = double(width) / p.width, y = double(height) / p.height;
  Camera small = camera;
  small.set_pinhole({p.fx * x, p.fy * y, (p.cx + 0.5) * x - 0.5, (p.cy + 0.5) * y - 0.5, width, height});
  return small;
}

Camera turned_camera(const Camera& camera, int quarter_turns) {
  Camera turned = camera;
  for (int i = 0; i < quarter_turns; ++i) turned = turned_clockwise(turned);
  return turned;
}

Camera cut_camera(const Camera& camera, double x, double y, int width, int height) {
  const Pinhole p = camera.pinhole();
  Camera cut = camera;
  cut.set_pinhole({p.fx, p.fy, p.cx - x, p.cy - y, width, height});
  return cut;
}

}  // namespace edgevo
