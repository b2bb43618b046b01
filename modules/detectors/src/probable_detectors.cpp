// SPDX-License-Identifier: BSD-3-Clause
// The detectors that select edges by a probability: `structured`, `network` and `precomputed` among all
// maxima of the gradient, `combined` among the edges of Canny.
#include "detector_list.h"
#include "edgevo/edges/adaptive_threshold.h"
#include "edgevo/edges/canny.h"
#include "probable_edges.h"

namespace edgevo {
namespace {

Plane<uint8_t> canny_at(const Gradient& gradient, const EdgeParams& params) {
  const double high = high_threshold(gradient.magnitude, params);
  return canny(gradient, float(params.canny_low_ratio * high), float(high));
}

// As many pixels as Canny would find.
Plane<uint8_t> chosen(const Plane<uint8_t>& candidates, const EdgeImage& image, const EdgeParams& params) {
  const int budget = count_linked(canny_at(image.gradient, params), params.min_chain);
  return most_probable(candidates, image.gradient, image.probability, budget, params.min_chain);
}

// The probability alone decides what is an edge, provided that the gradient, above Canny's smallest low
// threshold, gives its position.
class ProbableDetector : public EdgeDetector {
 public:
  explicit ProbableDetector(const EdgeParams& params) : params_(params) {}

  Plane<uint8_t> detect(const EdgeImage& image) override {
    const float floor = float(params_.canny_low_ratio * params_.min_gradient) * kSobelPerGrayLevel;
    return chosen(canny(image.gradient, floor, floor), image, params_);
  }

 private:
  EdgeParams params_;
};

// Canny with twice as many pixels above its threshold, reduced to as many edge pixels as it would normally
// find.
class CombinedDetector : public EdgeDetector {
 public:
  explicit CombinedDetector(const EdgeParams& params) : params_(params), wide_(params) {
    wide_.canny_percentile = 1.0 - 2.0 * (1.0 - params.canny_percentile);
  }

  Plane<uint8_t> detect(const EdgeImage& image) override {
    return chosen(canny_at(image.gradient, wide_), image, params_);
  }

 private:
  EdgeParams params_, wide_;
};

}  // namespace

std::unique_ptr<EdgeDetector> make_probable_detector(const EdgeParams& params) {
  return std::make_unique<ProbableDetector>(params);
}
std::unique_ptr<EdgeDetector> make_combined_detector(const EdgeParams& params) {
  return std::make_unique<CombinedDetector>(params);
}

}  // namespace edgevo
