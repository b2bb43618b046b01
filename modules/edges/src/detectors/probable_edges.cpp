#include "probable_edges.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <functional>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "canny.h"
#include "edgevo/core/error.h"
#include "opencv_view.h"

namespace edgevo {
namespace {

constexpr int kReach = 2;  // pixels: networks that halve the image twice are off by as many

void check_there(const ImageView<uint8_t>& probability) {
  if (probability.data == nullptr)
    throw InputError("edges.detector", "needs a probability, and there is none",
                     "build pyramids with the detector's own");
}

// Sixteen bits, smoothed over a pixel: eight bits have plateaus on top of a ridge.
Plane<uint16_t> smoothed(const ImageView<uint8_t>& probability) {
  cv::Mat wide;
  as_mat(probability).convertTo(wide, CV_16U, 257.0);
  Plane<uint16_t> out(probability.width, probability.height);
  cv::GaussianBlur(wide, as_mat(out), cv::Size(5, 5), 1.0, 1.0, cv::BORDER_REPLICATE);
  return out;
}

// Calls visit(x, y) for all marked pixels, row by row.
template <class Visit>
void for_each_marked(const Plane<uint8_t>& mask, const Visit& visit) {
  for (int y = 0; y < mask.height(); ++y) {
    const uint8_t* row = mask.row(y);
    for (int x = 0; x < mask.width(); ++x)
      if (row[x]) visit(x, y);
  }
}

// The pixel `steps` along the gradient from (x, y), kept inside the image.
struct Across {
  const Gradient& gradient;

  cv::Point at(int x, int y, int steps) const {
    const float dx = gradient.dx.at(x, y), dy = gradient.dy.at(x, y),
                length = std::max(std::hypot(dx, dy), 1.0f);
    return {std::clamp(int(std::lrint(x + steps * dx / length)), 0, gradient.dx.width() - 1),
            std::clamp(int(std::lrint(y + steps * dy / length)), 0, gradient.dx.height() - 1)};
  }
};

struct Scored {
  int x, y;
  uint16_t score;
};

std::vector<Scored> score_all(const Plane<uint8_t>& candidates, const Gradient& gradient,
                              const Plane<uint16_t>& probability) {
  std::vector<Scored> all;
  const Across across{gradient};
  for_each_marked(candidates, [&](int x, int y) {
    uint16_t best = 0;
    for (int t = -kReach; t <= kReach; ++t) {
      const cv::Point p = across.at(x, y, t);
      best = std::max(best, probability.at(p.x, p.y));
    }
    if (best > 0) all.push_back({x, y, best});
  });
  return all;
}

// The score of the rank-th best, from 0; beyond the last one the smallest that counts.
uint16_t score_of_rank(std::vector<uint16_t>* scores, int rank) {
  if (rank >= int(scores->size())) return 1;
  std::nth_element(scores->begin(), scores->begin() + rank, scores->end(), std::greater<>());
  return (*scores)[size_t(rank)];
}

}  // namespace

int count_marked(const Plane<uint8_t>& mask) { return cv::countNonZero(as_mat(mask)); }

Plane<uint8_t> most_probable(const Plane<uint8_t>& candidates, const Gradient& gradient,
                             const ImageView<uint8_t>& probability, int budget) {
  check_there(probability);
  const std::vector<Scored> all = score_all(candidates, gradient, smoothed(probability));
  std::vector<uint16_t> scores;
  for (const Scored& s : all) scores.push_back(s.score);
  const uint16_t low = score_of_rank(&scores, budget), high = score_of_rank(&scores, budget / 2);
  Plane<uint8_t> mask(candidates.width(), candidates.height());
  std::memset(mask.row(0), 0, size_t(mask.width()) * mask.height());
  for (const Scored& s : all)
    if (s.score >= low) mask.at(s.x, s.y) = s.score >= high ? kStrongMark : kWeakMark;
  keep_linked(&mask);
  return mask;
}

}  // namespace edgevo
