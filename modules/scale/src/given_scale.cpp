// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/scale/given_scale.h"

#include <cmath>

#include "edgevo/core/error.h"
#include "edgevo/core/record_units.h"

namespace edgevo {
namespace {

SE3 scaled(const SE3& T, double factor) { return {T.rotation(), factor * T.translation()}; }

}  // namespace

void scale_run(double factor, const std::string& source, Run* run) {
  if (!(factor > 0) || !std::isfinite(factor))
    throw InputError("scale", "the factor is not a positive number", "give metres per unit of the run");
  for (FrameRecord& f : run->frames) {
    if (f.T_world_cam) f.T_world_cam = scaled(*f.T_world_cam, factor);
    if (f.T_world_cam_live) f.T_world_cam_live = scaled(*f.T_world_cam_live, factor);
    multiply_lengths(factor, &f);
  }
  for (KeyframeRecord& k : run->keyframes) {
    k.T_world_cam = scaled(k.T_world_cam, factor);
    multiply_depths(factor, &k);
  }
  run->scale_source = source;
  run->scale.factor = run->scale.lowest = run->scale.highest = factor;
}

}  // namespace edgevo
