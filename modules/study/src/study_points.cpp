// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/study/study_points.h"

#include <algorithm>
#include <numeric>

#include "edgevo/simulation/correspondence.h"

namespace edgevo {

std::vector<StudyPoint> sample_points(const ImageEdges& edges, const ImageView<float>& depth, int count,
                                      double noise, Random* random) {
  std::vector<int> order(edges.pixels.size());
  std::iota(order.begin(), order.end(), 0);
  std::vector<StudyPoint> points;
  // A partial shuffle, as far as points are needed.
  for (size_t i = 0; i < order.size() && int(points.size()) < count; ++i) {
    std::swap(order[i], order[i + size_t(random->below(int(order.size() - i)))]);
    const EdgePixel& edge = edges.pixels[size_t(order[i])];
    StudyPoint p;
    p.px = edge.position().cast<double>();
    p.normal = edge.normal().cast<double>();
    p.idepth_true = edge_idepth(depth, p.px);
    const double n = random->normal();
    if (!(p.idepth_true > 0)) continue;  // sky
    p.idepth = p.idepth_true * std::max(1 + noise * n, 0.1);
    p.idepth_sigma = noise * p.idepth_true;
    points.push_back(p);
  }
  return points;
}

}  // namespace edgevo
