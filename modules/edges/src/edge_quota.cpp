// SPDX-License-Identifier: BSD-3-Clause
#include "edge_quota.h"

#include <algorithm>
#include <utility>

namespace edgevo {
namespace {

constexpr int kCellPx = 64;  // some hundred cells an image, each with many chains

// Number of edge pixels that each cell of an image may hold.
class CellQuota {
 public:
  CellQuota(const PixelChains& all, int width, int height, int most)
      : columns_((width + kCellPx - 1) / kCellPx),
        held_(size_t(columns_) * size_t((height + kCellPx - 1) / kCellPx), 0) {
    for (const MaskPixel& p : all.pixels) ++held_[cell_of(p)];
    quota_ = quota_of(held_, most);
    std::fill(held_.begin(), held_.end(), 0);
  }

  // True if three quarters of the chain lie in cells with room; it is then counted in.
  bool take(const MaskPixel* begin, const MaskPixel* end) {
    const auto has_room = [&](const MaskPixel& p) { return held_[cell_of(p)] < quota_; };
    if (4 * std::count_if(begin, end, has_room) < 3 * (end - begin)) return false;
    for (const MaskPixel* p = begin; p != end; ++p) ++held_[cell_of(*p)];
    return true;
  }

 private:
  size_t cell_of(const MaskPixel& p) const {
    return size_t(p.y / kCellPx) * size_t(columns_) + size_t(p.x / kCellPx);
  }

  // The quota with which the cells hold `most` pixels together: what a cell with few leaves goes to the
  // others.
  static int quota_of(std::vector<int> counts, int most) {
    std::sort(counts.begin(), counts.end());
    int left = most;
    for (size_t i = 0; i < counts.size(); ++i) {
      const int share = left / int(counts.size() - i);
      if (counts[i] > share) return share;
      left -= counts[i];
    }
    return most;
  }

  int columns_;
  std::vector<int> held_;
  int quota_ = 0;
};

// Sum of the gradient magnitudes over the number of pixels.
double strength_of(const PixelChains& all, const EdgeChain& chain, const Gradient& gradient) {
  double sum = 0;
  for (int i = chain.begin; i < chain.end; ++i)
    sum += double(gradient.magnitude.at(all.pixels[size_t(i)].x, all.pixels[size_t(i)].y));
  return sum / (chain.end - chain.begin);
}

// Indices of the chains, the strongest first.
std::vector<size_t> by_strength(const PixelChains& all, const Gradient& gradient) {
  std::vector<std::pair<double, size_t>> ranked;
  for (size_t c = 0; c < all.chains.size(); ++c)
    ranked.emplace_back(-strength_of(all, all.chains[c], gradient), c);
  std::sort(ranked.begin(), ranked.end());
  std::vector<size_t> order;
  for (const auto& [strength, c] : ranked) order.push_back(c);
  return order;
}

}  // namespace

PixelChains within_quota(PixelChains all, const Gradient& gradient, int most) {
  if (int(all.pixels.size()) <= most) return all;
  CellQuota quota(all, gradient.magnitude.width(), gradient.magnitude.height(), most);
  std::vector<bool> is_kept(all.chains.size());
  for (const size_t c : by_strength(all, gradient)) {
    const EdgeChain& chain = all.chains[c];
    is_kept[c] = quota.take(all.pixels.data() + chain.begin, all.pixels.data() + chain.end);
  }
  PixelChains kept;
  kept.pixels.reserve(size_t(most));
  for (size_t c = 0; c < all.chains.size(); ++c) {
    if (!is_kept[c]) continue;
    const int begin = int(kept.pixels.size());
    kept.pixels.insert(kept.pixels.end(), all.pixels.begin() + all.chains[c].begin,
                       all.pixels.begin() + all.chains[c].end);
    kept.chains.push_back({begin, int(kept.pixels.size())});
  }
  return kept;
}

}  // namespace edgevo
