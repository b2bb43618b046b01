// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/calibration/calibration_picture.h"

#include <algorithm>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "edgevo/core/output_file.h"

namespace edgevo {
namespace {

constexpr int kWidth = 1000;             // width of the picture, pixels
constexpr int kCaption = 30;             // height of the caption, pixels
constexpr double kResidualShare = 0.02;  // of the width: drawn length of a residual equal to the rms

// Hues around the circle, by the golden ratio, so that neighbours differ.
cv::Scalar colour_of(size_t view) {
  const cv::Mat hsv(1, 1, CV_8UC3, cv::Scalar(double(view * 111 % 180), 220, 170));
  cv::Mat bgr;
  cv::cvtColor(hsv, bgr, cv::COLOR_HSV2BGR);
  const cv::Vec3b c = bgr.at<cv::Vec3b>(0);
  return {double(c[0]), double(c[1]), double(c[2])};
}

void draw_view(const ViewFit& view, const cv::Scalar& colour, double scale, double magnification,
               cv::Mat* picture) {
  for (size_t i = 0; i < view.px.size(); ++i) {
    const cv::Point2d at(scale * double(view.px[i].x()), scale * double(view.px[i].y()));
    const cv::Point2d to =
        at + magnification * cv::Point2d(double(view.residual_px[i].x()), double(view.residual_px[i].y()));
    cv::circle(*picture, at, 2, colour, cv::FILLED, cv::LINE_AA);
    cv::line(*picture, at, to, colour, 1, cv::LINE_AA);
  }
}

}  // namespace

std::string calibration_picture(const CameraCalibration& c) {
  const Pinhole p = c.camera.pinhole();
  const double scale = double(kWidth) / p.width;
  const double magnification = kResidualShare * kWidth / std::max(c.rms_px, 1e-6);
  const int height = std::max(1, int(scale * p.height));
  cv::Mat picture(height + kCaption, kWidth, CV_8UC3, cv::Scalar::all(255));
  for (size_t v = 0; v < c.views.size(); ++v)
    draw_view(c.views[v], colour_of(v), scale, magnification, &picture);
  cv::rectangle(picture, {0, 0, kWidth, height}, cv::Scalar::all(120));
  const std::string caption = std::to_string(c.views.size()) + " views, rms " + fixed(c.rms_px, 3) +
                              " px; residuals drawn " + fixed(magnification / scale, 0) + " times too long";
  cv::putText(picture, caption, {10, height + kCaption - 10}, cv::FONT_HERSHEY_SIMPLEX, 0.55,
              cv::Scalar::all(0), 1, cv::LINE_AA);
  std::vector<uchar> bytes;
  cv::imencode(".png", picture, bytes);
  return {bytes.begin(), bytes.end()};
}

}  // namespace edgevo
