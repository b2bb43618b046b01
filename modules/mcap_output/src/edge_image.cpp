// SPDX-License-Identifier: BSD-3-Clause
#include "edge_image.h"

#include <algorithm>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>

namespace edgevo {
namespace {

// Below it edges get visible rings; a larger one costs bytes and shows no more.
constexpr int kJpegQuality = 75;
const cv::Vec3b kEdgeColour(230, 160, 60), kPointColour(80, 230, 80);  // blue, green, red

// The image in three equal channels.
cv::Mat in_colour(const Plane<uint8_t>& gray) {
  const auto view = gray.view();
  cv::Mat image(view.height, view.width, CV_8UC3);
  for (int y = 0; y < view.height; ++y)
    for (int x = 0; x < view.width; ++x) image.at<cv::Vec3b>(y, x) = cv::Vec3b::all(view.at(x, y));
  return image;
}

void mark(const Eigen::Vector2f& px, const cv::Vec3b& colour, cv::Mat* image) {
  const int x = int(px.x() + 0.5f), y = int(px.y() + 0.5f);
  if (x >= 0 && y >= 0 && x < image->cols && y < image->rows) image->at<cv::Vec3b>(y, x) = colour;
}

}  // namespace

std::string edge_image(const FrameView& view) {
  const PyramidLevel& level = view.pyramid->finest();
  cv::Mat image = in_colour(level.gray);
  for (const EdgePixel& e : level.edges.pixels) mark(e.position(), kEdgeColour, &image);
  for (const SeenPoint& p : view.points)
    for (const auto& [dx, dy] : {std::pair{0.f, 0.f}, {1.f, 0.f}, {0.f, 1.f}, {1.f, 1.f}})
      mark(p.px + Eigen::Vector2f(dx, dy), kPointColour, &image);
  std::vector<uchar> jpeg;
  cv::imencode(".jpg", image, jpeg, {cv::IMWRITE_JPEG_QUALITY, kJpegQuality});
  return {jpeg.begin(), jpeg.end()};
}

}  // namespace edgevo
