// SPDX-License-Identifier: BSD-3-Clause
#include "view_image.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

namespace edgevo {
namespace {

constexpr float kWorstResidualPx = 3;
const cv::Vec3b kEdgeColour(150, 110, 70);

cv::Mat to_bgr(const Plane<uint8_t>& gray) {
  const auto view = gray.view();
  const cv::Mat pixels(view.height, view.width, CV_8UC1, const_cast<uint8_t*>(view.data),
                       size_t(view.stride));
  cv::Mat bgr;
  cv::cvtColor(pixels, bgr, cv::COLOR_GRAY2BGR);
  return bgr;
}

/// A range of values, mapped to 0 (low) to 1 (high).
struct Range {
  float low = 0, high = 1;
  float share(float x) const { return std::clamp((x - low) / std::max(high - low, 1e-12f), 0.f, 1.f); }
};

Range inverse_depth_range(const std::vector<SeenPoint>& points) {
  std::vector<float> values;
  for (const SeenPoint& p : points) values.push_back(p.idepth);
  if (values.empty()) return {};
  std::sort(values.begin(), values.end());
  const auto at = [&](double share) { return values[size_t(share * double(values.size() - 1))]; };
  return {at(0.05), at(0.95)};
}

// Colour of hue from `hue_of_zero` (share 0) to 0, red (share 1), in OpenCV's half degrees; 120: blue.
cv::Vec3b rainbow(float share, int hue_of_zero) {
  const cv::Mat hsv(1, 1, CV_8UC3, cv::Scalar(double(hue_of_zero) * double(1 - share), 255, 255));
  cv::Mat bgr;
  cv::cvtColor(hsv, bgr, cv::COLOR_HSV2BGR);
  return bgr.at<cv::Vec3b>(0, 0);
}

std::vector<cv::Vec3b> colour_table(int hue_of_zero) {
  std::vector<cv::Vec3b> table;
  for (int i = 0; i < 64; ++i) table.push_back(rainbow(float(i) / 63, hue_of_zero));
  return table;
}

const cv::Vec3b& by_depth(float share) {
  static const std::vector<cv::Vec3b> table = colour_table(120);
  return table[size_t(share * 63)];
}

const cv::Vec3b& by_residual(float residual_px) {
  static const std::vector<cv::Vec3b> table = colour_table(60);
  const float worst = std::isfinite(residual_px) ? std::abs(residual_px) : kWorstResidualPx;
  return table[size_t(std::min(worst / kWorstResidualPx, 1.f) * 63)];
}

void draw_edges(const ImageEdges& edges, cv::Mat* picture) {
  for (const EdgePixel& e : edges.pixels)
    picture->at<cv::Vec3b>(int(std::lround(e.y)), int(std::lround(e.x))) = kEdgeColour;
}

}  // namespace

cv::Mat draw_frame(const FrameView& view, PointColour colour) {
  const PyramidLevel& finest = view.pyramid->finest();
  cv::Mat picture = to_bgr(finest.gray);
  draw_edges(finest.edges, &picture);
  const Range range = inverse_depth_range(view.points);
  const cv::Rect whole(0, 0, picture.cols, picture.rows);
  for (const SeenPoint& p : view.points) {
    const cv::Rect dot(int(std::lround(p.px.x())) - 1, int(std::lround(p.px.y())) - 1, 3, 3);
    picture(dot & whole) =
        colour == PointColour::kDepth ? by_depth(range.share(p.idepth)) : by_residual(p.residual_px);
  }
  return picture;
}

}  // namespace edgevo
