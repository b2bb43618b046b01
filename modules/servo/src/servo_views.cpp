// SPDX-License-Identifier: BSD-3-Clause
#include "servo_views.h"

#include <cmath>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "edgevo/core/rectification.h"

namespace edgevo {
namespace {

cv::Point2d pixel(const Camera& camera, const Eigen::Vector2d& undistorted_px) {
  const Eigen::Vector2d px = Rectification(camera).raw_pixel(camera.pinhole().ray(undistorted_px).head<2>());
  return {px.x(), px.y()};
}

// Drawing coordinates in sixteenths of a pixel.
cv::Point fine(const cv::Point2d& p) { return {int(std::lround(16 * p.x)), int(std::lround(16 * p.y))}; }

std::vector<uint8_t> view_png(const Camera& camera, const GrayImage& image,
                              const std::vector<Eigen::Vector2d>& now,
                              const std::vector<Eigen::Vector2d>& wanted) {
  const cv::Mat gray(image.height, image.width, CV_8U, const_cast<uint8_t*>(image.pixels.data()));
  cv::Mat picture;
  cv::cvtColor(gray, picture, cv::COLOR_GRAY2BGR);
  for (const Eigen::Vector2d& px : wanted)
    cv::circle(picture, fine(pixel(camera, px)), 16 * 7, {60, 200, 60}, 2, cv::LINE_AA, 4);
  for (const Eigen::Vector2d& px : now) {
    const cv::Point2d p = pixel(camera, px);
    cv::line(picture, fine(p - cv::Point2d(5, 5)), fine(p + cv::Point2d(5, 5)), {40, 60, 230}, 1, cv::LINE_AA,
             4);
    cv::line(picture, fine(p - cv::Point2d(5, -5)), fine(p + cv::Point2d(5, -5)), {40, 60, 230}, 1,
             cv::LINE_AA, 4);
  }
  std::vector<uint8_t> png;
  cv::imencode(".png", picture, png);
  return png;
}

}  // namespace

std::vector<ServoView> views_of(const ServoResult& r) {
  std::vector<ServoView> views;
  if (!r.start.empty())
    views.push_back({"start", view_png(r.camera, r.start, r.points_start, r.points_taught)});
  if (!r.taught.empty())
    views.push_back({"taught", view_png(r.camera, r.taught, r.points_taught, r.points_taught)});
  if (!r.final.empty())
    views.push_back({"final", view_png(r.camera, r.final, r.points_final, r.points_taught)});
  return views;
}

}  // namespace edgevo
