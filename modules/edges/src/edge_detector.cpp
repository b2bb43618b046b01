#include "edgevo/edges/edge_detector.h"

#include <algorithm>
#include <cmath>
#include <opencv2/ximgproc/edge_drawing.hpp>

#include "edgevo/core/error.h"
#include "canny.h"
#include "opencv_view.h"

namespace edgevo {
namespace {

// The high threshold: a percentile of the gradient, but below its peak, which many pixels may share (stripes, a chessboard), and
// not below the floor.
double high_threshold(const Plane<float>& magnitude, const EdgeParams& params) {
  constexpr double kShareOfPeak = 0.7;
  const GradientHistogram histogram(magnitude);
  const double percentile = histogram.percentile(params.canny_percentile), peak = histogram.percentile(1.0);
  return std::max(std::min(percentile, kShareOfPeak * peak), params.min_gradient * kSobelPerGrayLevel);
}

class CannyDetector : public EdgeDetector {
 public:
  explicit CannyDetector(const EdgeParams& params) : params_(params) {}

  Plane<uint8_t> detect(const ImageView<uint8_t>&, const Gradient& gradient) override {
    const double high = high_threshold(gradient.magnitude, params_);
    return canny(gradient, float(params_.canny_low_ratio * high), float(high));
  }

 private:
  EdgeParams params_;
};

class EdgeDrawingDetector : public EdgeDetector {
 public:
  explicit EdgeDrawingDetector(const EdgeParams& params)
      : params_(params), drawing_(cv::ximgproc::createEdgeDrawing()) {}

  Plane<uint8_t> detect(const ImageView<uint8_t>& gray, const Gradient& gradient) override {
    const double high = high_threshold(gradient.magnitude, params_);
    // EdgeDrawing draws on from anchors through all pixels over its threshold, as Canny does above its low one. It sums
    // |dx| + |dy|, on average 4/pi of the Euclidean magnitude.
    drawing_->params.EdgeDetectionOperator = cv::ximgproc::EdgeDrawing::SOBEL;
    drawing_->params.GradientThresholdValue = std::max(1, int(params_.canny_low_ratio * high * 4.0 / M_PI));
    drawing_->params.AnchorThresholdValue = 8;
    drawing_->params.MinPathLength = params_.min_chain;
    drawing_->params.PFmode = false;
    cv::Mat found;
    drawing_->detectEdges(as_mat(gray));
    drawing_->getEdgeImage(found);
    Plane<uint8_t> mask(gray.width, gray.height);
    found.copyTo(as_mat(mask));
    return mask;
  }

 private:
  EdgeParams params_;
  cv::Ptr<cv::ximgproc::EdgeDrawing> drawing_;
};

}  // namespace

void EdgeParams::visit(ParamVisitor& v) {
  v.text("detector", detector, edge_detector_names(), "what marks edge pixels");
  v.integer("levels", levels, 1, 8, "levels of the image pyramid");
  v.integer("edge_levels", edge_levels, 1, 4, "finest levels that get edges and a nearest-neighbour field");
  v.number("canny_percentile", canny_percentile, 0.5, 0.99, "high threshold: this share of the pixels has a smaller gradient");
  v.number("canny_low_ratio", canny_low_ratio, 0.1, 1.0, "low threshold over high threshold");
  v.number("min_gradient", min_gradient, 0.5, 50, "floor of the high threshold, gray levels per pixel");
  v.integer("min_chain", min_chain, 2, 100, "shorter edges are dropped, pixels");
  v.integer("field_radius", field_radius, 2, 15, "nearest-neighbour fields reach this far, pixels");
}

std::vector<std::string> edge_detector_names() { return {"canny", "edge_drawing"}; }

std::unique_ptr<EdgeDetector> make_edge_detector(const EdgeParams& params) {
  if (params.detector == "canny") return std::make_unique<CannyDetector>(params);
  if (params.detector == "edge_drawing") return std::make_unique<EdgeDrawingDetector>(params);
  throw InputError("edges.detector", "unknown detector '" + params.detector + "'",
                   "did you mean '" + nearest_name(params.detector, edge_detector_names()) + "'?");
}

}  // namespace edgevo
