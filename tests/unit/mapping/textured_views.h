// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Views of a textured scene that features link (features/view_link.h).
#include <algorithm>
#include <memory>
#include <utility>

#include "edgevo/confidence/integrity_monitor.h"
#include "edgevo/core/random.h"
#include "edgevo/edges/frame_pyramid.h"

namespace edgevo::test {

inline const Pinhole kTexturedPinhole{300, 300, 160, 120, 320, 240};

// Squares of random size and brightness.
inline Plane<uint8_t> texture(uint64_t seed) {
  Random random(seed);
  Plane<uint8_t> image(320, 240);
  std::fill_n(image.row(0), 320 * 240, uint8_t(128));
  for (int n = 0; n < 1500; ++n) {
    const int x = int(random.uniform(0, 310)), y = int(random.uniform(0, 230)),
              gray = int(random.uniform(0, 255)), size = int(random.uniform(3, 10));
    for (int v = y; v < y + size; ++v)
      for (int u = x; u < x + size; ++u) image.at(u, v) = uint8_t(gray);
  }
  return image;
}

// The image after a step to the side: far things above, near ones below.
inline Plane<uint8_t> after_a_step(const Plane<uint8_t>& image) {
  Plane<uint8_t> moved(320, 240);
  for (int v = 0; v < 240; ++v)
    for (int u = 0; u < 320; ++u) moved.at(u, v) = image.at((u + (v < 120 ? 8 : 24)) % 320, v);
  return moved;
}

// A view of `image`, whose near points lie `depth` away in its map.
inline TrustedReference textured_view(int keyframe, int segment, Plane<uint8_t> image, double depth) {
  auto pyramid = std::make_shared<FramePyramid>();
  pyramid->levels.emplace_back().gray = std::move(image);
  auto reference = std::make_shared<Reference>();
  reference->keyframe_id = keyframe;
  reference->cloud.pyramid = pyramid;
  for (float y = 4; y < 240; y += 8)
    for (float x = 4; x < 320; x += 8) {
      CloudPoint p{};
      p.px = {x, y};
      p.normal = {1, 0};
      p.ray = kTexturedPinhole.ray({x, y});
      const double z = y < 120 ? 3 * depth : depth;
      p.idepth = 1 / z;
      p.idepth_sigma = 0.02 / z;
      p.host_keyframe = 1;
      reference->cloud.points.push_back(p);
    }
  return {keyframe, segment, reference};
}

}  // namespace edgevo::test
