// SPDX-License-Identifier: BSD-3-Clause
// OpenCV's EdgeDrawing: follows edges from anchors through all pixels above its threshold, as Canny does
// above its low threshold.
#include <algorithm>
#include <cmath>
#include <opencv2/ximgproc/edge_drawing.hpp>

#include "detector_list.h"
#include "edgevo/edges/adaptive_threshold.h"
#include "edgevo/edges/opencv_view.h"

namespace edgevo {
namespace {

// An anchor exceeds its neighbours across the edge by this much, which noise does not; EdgeDrawing's units,
// |dx| + |dy|.
constexpr int kAnchorThreshold = 8;

class EdgeDrawingDetector : public EdgeDetector {
 public:
  explicit EdgeDrawingDetector(const EdgeParams& params)
      : params_(params), drawing_(cv::ximgproc::createEdgeDrawing()) {}

  Plane<uint8_t> detect(const EdgeImage& image) override {
    const double high = high_threshold(image.gradient.magnitude, params_);
    drawing_->params.EdgeDetectionOperator = cv::ximgproc::EdgeDrawing::SOBEL;
    // It uses |dx| + |dy|, which on average over all directions is 4/pi of the Euclidean magnitude.
    drawing_->params.GradientThresholdValue = std::max(1, int(params_.canny_low_ratio * high * 4.0 / M_PI));
    drawing_->params.AnchorThresholdValue = kAnchorThreshold;
    drawing_->params.MinPathLength = params_.min_chain;
    drawing_->params.PFmode = false;
    cv::Mat found;
    drawing_->detectEdges(as_mat(image.gray));
    drawing_->getEdgeImage(found);
    Plane<uint8_t> mask(image.gray.width, image.gray.height);
    found.copyTo(as_mat(mask));
    return mask;
  }

 private:
  EdgeParams params_;
  cv::Ptr<cv::ximgproc::EdgeDrawing> drawing_;
};

}  // namespace

std::unique_ptr<EdgeDetector> make_edge_drawing_detector(const EdgeParams& params) {
  return std::make_unique<EdgeDrawingDetector>(params);
}

}  // namespace edgevo
