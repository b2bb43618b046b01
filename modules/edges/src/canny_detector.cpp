// SPDX-License-Identifier: BSD-3-Clause
// Canny with adaptive thresholds, so that the number of edge pixels stays constant when the exposure changes.
#include "canny_detector.h"

#include "edgevo/edges/adaptive_threshold.h"
#include "edgevo/edges/canny.h"

namespace edgevo {
namespace {

class CannyDetector : public EdgeDetector {
 public:
  explicit CannyDetector(const EdgeParams& params) : params_(params) {}

  Plane<uint8_t> detect(const EdgeImage& image) override {
    const double high = high_threshold(image.gradient.magnitude, params_);
    return canny(image.gradient, float(params_.canny_low_ratio * high), float(high));
  }

 private:
  EdgeParams params_;
};

}  // namespace

std::unique_ptr<EdgeDetector> make_canny_detector(const EdgeParams& params) {
  return std::make_unique<CannyDetector>(params);
}

}  // namespace edgevo
