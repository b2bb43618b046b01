// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/alignment/reference_cloud.h"

#include <cmath>

namespace edgevo {

ReferenceCloud make_reference_cloud(std::shared_ptr<const FramePyramid> pyramid,
                                    std::vector<CloudPoint> points, bool with_gradient_patches) {
  ReferenceCloud cloud;
  cloud.pyramid = std::move(pyramid);
  cloud.points = std::move(points);
  std::vector<Eigen::Vector2f> positions(cloud.points.size());
  for (size_t l = 0; l < cloud.pyramid->levels.size(); ++l) {
    const float s = std::ldexp(1.0f, -int(l));
    for (size_t i = 0; i < positions.size(); ++i) positions[i] = s * cloud.points[i].px;
    const PyramidLevel& level = cloud.pyramid->levels[l];
    cloud.patches.push_back(l == 0 ? PatchTemplates() : level.with_gray([&](const auto& gray) {
      return cut_patches(gray, positions);
    }));
    if (l == 0 && with_gradient_patches)
      cloud.gradient_patches = cut_patches(level.gradient_magnitude.view(), positions);
  }
  return cloud;
}

ReferenceCloud part_of(const ReferenceCloud& all, const std::vector<size_t>& kept) {
  ReferenceCloud part{all.pyramid, {}, {}, {}};
  part.patches.resize(all.patches.size());
  for (size_t i : kept) {
    part.points.push_back(all.points[i]);
    for (size_t l = 0; l < all.patches.size(); ++l)
      if (!all.patches[l].empty()) part.patches[l].push_back(all.patches[l][i]);
    if (!all.gradient_patches.empty()) part.gradient_patches.push_back(all.gradient_patches[i]);
  }
  return part;
}

}  // namespace edgevo
