// The detectors that choose by a probability: `structured`, `network` and `precomputed` among all maxima of
// the gradient, `combined` among Canny's.
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

// As many as Canny would have.
Plane<uint8_t> chosen(const Plane<uint8_t>& candidates, const EdgeImage& image, const EdgeParams& params) {
  const int budget = count_linked(canny_at(image.gradient, params), params.min_chain);
  return most_probable(candidates, image.gradient, image.probability, budget, params.min_chain);
}

// What an edge is, the probability says alone, as long as there is a gradient to place it by: more than
// Canny's least low threshold.
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

// Canny with twice as many pixels above its threshold, and of its edges as many as it would have had.
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
