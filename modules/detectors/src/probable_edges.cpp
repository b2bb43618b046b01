// SPDX-License-Identifier: BSD-3-Clause
#include "probable_edges.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "edgevo/core/error.h"
#include "edgevo/edges/edge_links.h"
#include "edgevo/edges/opencv_view.h"

namespace edgevo {
namespace {

constexpr int kReach = 2;  // pixels: networks that halve the image twice are off by up to two
constexpr uint8_t kMark = 255;

void check_there(const ImageView<uint8_t>& probability) {
  if (probability.data == nullptr)
    throw InputError("edges.detector", "needs a probability, but there is none",
                     "build pyramids with the probability of the detector");
}

// Sixteen bits, smoothed over a pixel, since eight bits have plateaus on a ridge.
Plane<uint16_t> smoothed(const ImageView<uint8_t>& probability) {
  cv::Mat wide;
  as_mat(probability).convertTo(wide, CV_16U, 257.0);
  Plane<uint16_t> out(probability.width, probability.height);
  cv::GaussianBlur(wide, as_mat(out), cv::Size(5, 5), 1.0, 1.0, cv::BORDER_REPLICATE);
  return out;
}

// The largest probability across the edge, up to kReach pixels away, kept inside the image.
int score_at(MaskPixel p, const Gradient& gradient, const Plane<uint16_t>& probability) {
  const float dx = gradient.dx.at(p.x, p.y), dy = gradient.dy.at(p.x, p.y),
              length = std::max(std::hypot(dx, dy), 1.0f);
  int best = 0;
  for (int t = -kReach; t <= kReach; ++t) {
    const int x = std::clamp(int(std::lrint(p.x + t * dx / length)), 0, probability.width() - 1);
    const int y = std::clamp(int(std::lrint(p.y + t * dy / length)), 0, probability.height() - 1);
    best = std::max<int>(best, probability.at(x, y));
  }
  return best;
}

struct Ranked {
  double score;  // mean over the chain
  EdgeChain chain;
};

// Best first; among equals the one that was walked first.
std::vector<Ranked> ranked(const PixelChains& candidates, const Gradient& gradient,
                           const Plane<uint16_t>& probability) {
  std::vector<Ranked> all;
  for (const EdgeChain& chain : candidates.chains) {
    int64_t sum = 0;
    for (int i = chain.begin; i < chain.end; ++i)
      sum += score_at(candidates.pixels[size_t(i)], gradient, probability);
    if (sum > 0) all.push_back({double(sum) / chain.length(), chain});
  }
  std::stable_sort(all.begin(), all.end(),
                   [](const Ranked& a, const Ranked& b) { return a.score > b.score; });
  return all;
}

}  // namespace

int count_linked(const Plane<uint8_t>& mask, int min_chain) {
  return int(link_edges(mask, min_chain).pixels.size());
}

Plane<uint8_t> most_probable(const Plane<uint8_t>& candidates, const Gradient& gradient,
                             const ImageView<uint8_t>& probability, int budget, int min_chain) {
  check_there(probability);
  Plane<uint8_t> mask(candidates.width(), candidates.height());
  std::memset(mask.row(0), 0, size_t(mask.width()) * mask.height());
  const PixelChains chains = link_edges(candidates, min_chain);
  int kept = 0;
  for (const Ranked& next : ranked(chains, gradient, smoothed(probability))) {
    if (kept >= budget) break;
    kept += next.chain.length();
    for (int i = next.chain.begin; i < next.chain.end; ++i)
      mask.at(chains.pixels[size_t(i)].x, chains.pixels[size_t(i)].y) = kMark;
  }
  return mask;
}

}  // namespace edgevo
