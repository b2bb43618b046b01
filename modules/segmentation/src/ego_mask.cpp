// SPDX-License-Identifier: BSD-3-Clause
#include "ego_mask.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "edgevo/core/error.h"
#include "edgevo/core/radial.h"
#include "edgevo/edges/opencv_view.h"

namespace edgevo {

namespace {

// Whether the smaller size is the other one times a scale, with sides rounded up or down to whole pixels.
bool is_same_shape(const cv::Size& a, const cv::Size& b) {
  const cv::Size& large = a.width > b.width ? a : b;
  const cv::Size& small = a.width > b.width ? b : a;
  if (small.height > large.height) return false;
  const double across = double(small.width) / large.width, down = double(small.height) / large.height;
  return std::abs(across - down) <= 1.0 / large.width + 1.0 / large.height;
}

// What a mask was drawn with, 0 where it is to give no edges: black, and where it has parts of both kinds,
// its transparency, too.
cv::Mat read_drawing(const std::string& path) {
  const cv::Mat image = cv::imread(path, cv::IMREAD_UNCHANGED), gray = cv::imread(path, cv::IMREAD_GRAYSCALE);
  if (image.channels() != 4) return gray;
  cv::Mat alpha;
  cv::extractChannel(image, alpha, 3);
  if (cv::countNonZero(alpha) == 0) return gray;
  return cv::min(alpha, gray);
}

}  // namespace

Plane<uint8_t> read_mask(const std::string& path, int width, int height) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error))  // OpenCV would print a warning of its own
    throw InputError(path, "is not a mask: no such file", "give a PNG, black where there are to be no edges");
  const cv::Mat image = read_drawing(path);
  if (image.empty())
    throw InputError(path, "cannot be read as an image", "give a PNG, black where there are to be no edges");
  const cv::Size size(width, height);
  if (!is_same_shape(image.size(), size))
    throw InputError(path,
                     "is " + std::to_string(image.cols) + "x" + std::to_string(image.rows) +
                         " but the images are " + std::to_string(width) + "x" + std::to_string(height),
                     "give a mask of the size of the images, or of that size times a scale");
  // Images may be scaled (--image-scale), or have been when the mask was found. A pixel that is partly black
  // gives no edges.
  Plane<uint8_t> mask(width, height);
  cv::Mat share = image == 0;
  if (share.size() != size) cv::resize(share, share, size, 0, 0, cv::INTER_AREA);
  cv::Mat(share > 0).copyTo(as_mat(mask));
  const int black = cv::countNonZero(as_mat(mask));
  if (black == 0 || black == width * height)
    throw InputError(path, black == 0 ? "has no black pixel (gray 0)" : "is black all over",
                     "paint black, or fully transparent, what is to give no edges, and nothing else");
  return mask;
}

namespace {

// Pixel of the raw image that a pixel of the rectified one shows.
Eigen::Vector2d source_of(const Eigen::Vector2d& px, const Rectification& rectification,
                          const ImageCorrection& correction) {
  if (rectification.is_identity() && correction.keeps_lens()) return px;
  return rectification.raw_pixel(add_lens(correction, rectification.target().ray(px).head<2>()));
}

}  // namespace

Plane<uint8_t> level_area(const Plane<uint8_t>& raw, const LevelSize& size,
                          const Rectification& rectification, const ImageCorrection& correction) {
  Plane<uint8_t> area(size.width, size.height);
  for (int y = 0; y < size.height; ++y)
    for (int x = 0; x < size.width; ++x) {
      const Eigen::Vector2d px =
          source_of(Eigen::Vector2d(x, y) * (1 << size.level), rectification, correction);
      const int u = int(std::lround(px.x())), v = int(std::lround(px.y()));
      const bool is_inside = u >= 0 && v >= 0 && u < raw.width() && v < raw.height();
      area.at(x, y) = is_inside ? raw.at(u, v) : 0;
    }
  return area;
}

Plane<uint8_t> raw_area(const Plane<uint8_t>& area, int level, const Rectification& rectification,
                        const ImageCorrection& correction) {
  const Pinhole& pinhole = rectification.target();
  Plane<uint8_t> raw(rectification.camera().width, rectification.camera().height);
  as_mat(raw).setTo(0);
  const bool same = rectification.is_identity() && correction.keeps_lens();
  for (int y = 0; y < pinhole.height; ++y)
    for (int x = 0; x < pinhole.width; ++x) {
      if (!area.at(std::min(x >> level, area.width() - 1), std::min(y >> level, area.height() - 1))) continue;
      const Eigen::Vector2d px = source_of(Eigen::Vector2d(x, y), rectification, correction);
      const int u = int(std::lround(px.x())), v = int(std::lround(px.y()));
      if (u >= 0 && v >= 0 && u < raw.width() && v < raw.height()) raw.at(u, v) = 255;
    }
  // Where the raw image is the finer one, gaps remain.
  if (!same)
    cv::morphologyEx(as_mat(raw), as_mat(raw), cv::MORPH_CLOSE,
                     cv::getStructuringElement(cv::MORPH_RECT, {5, 5}));
  return raw;
}

EgoMask::EgoMask(const std::string& path, int width, int height) {
  if (!path.empty()) given_ = std::make_shared<const Plane<uint8_t>>(read_mask(path, width, height));
  all_ = given_;
}

void EgoMask::set_found(Plane<uint8_t> found) {
  if (given_) cv::bitwise_or(as_mat(*given_), as_mat(found), as_mat(found));
  all_ = std::make_shared<const Plane<uint8_t>>(std::move(found));
}

}  // namespace edgevo
