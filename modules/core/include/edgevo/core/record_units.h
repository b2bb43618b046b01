#pragma once
#include "edgevo/core/records.h"

namespace edgevo {

/// The depths of a keyframe's points and lines in a unit of which there are `factor` > 0 in the old one.
inline void multiply_depths(double factor, KeyframeRecord* k) {
  const auto change = [factor](auto& p) {
    p.idepth = float(p.idepth / factor), p.idepth_sigma = float(p.idepth_sigma / factor);
  };
  for (EdgePoint& p : k->points) change(p);
  for (EdgeLine& line : k->lines)
    for (EdgeVertex& v : line.vertices) change(v);
}

}  // namespace edgevo
