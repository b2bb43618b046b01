// SPDX-License-Identifier: BSD-3-Clause
#include "border_mask.h"

#include <algorithm>
#include <opencv2/imgproc.hpp>

#include "edgevo/edges/opencv_view.h"

namespace edgevo {
namespace {

constexpr int kBlurPx = 9;  // side of the mean filter: sensor noise, JPEG blocks
// Largest gray level of black: 16 in video, plus an offset. Anything lighter belongs to the scene, and so
// does what is lighter than the darkest of an image by more than the noise that remains after the blur.
constexpr double kBlackest = 20, kNoise = 5;
constexpr double kMinAreaShare = 0.04;  // of the image; smaller areas do little harm
// Areas are searched again once this share of them was lit: noise lights a pixel now and then.
constexpr double kWorthLooking = 0.01;
// The outline is blurred by this filter, the lens, the undistortion and the filter of the gradient.
constexpr int kMarginPx = kBlurPx / 2 + 6;
// One image is not enough to distinguish a black border from a dark corner of the scene.
constexpr int kImagesNeeded = 20;

bool reaches_border(const cv::Rect& box, const cv::Size& image) {
  return box.x == 0 || box.y == 0 || box.br().x == image.width || box.br().y == image.height;
}

// The large areas that touch the border.
cv::Mat at_border(const cv::Mat& black) {
  cv::Mat labels, boxes, centres, kept = cv::Mat::zeros(black.size(), CV_8U);
  const int count = cv::connectedComponentsWithStats(black, labels, boxes, centres, 4);
  for (int i = 1; i < count; ++i) {
    const cv::Rect box(boxes.at<int>(i, cv::CC_STAT_LEFT), boxes.at<int>(i, cv::CC_STAT_TOP),
                       boxes.at<int>(i, cv::CC_STAT_WIDTH), boxes.at<int>(i, cv::CC_STAT_HEIGHT));
    if (boxes.at<int>(i, cv::CC_STAT_AREA) >= kMinAreaShare * double(black.total()) &&
        reaches_border(box, black.size()))
      kept.setTo(255, labels == i);
  }
  return kept;
}

}  // namespace

void BorderMask::add(const ImageView<uint8_t>& image) {
  const bool is_first = images_++ == 0;
  if (!is_first && black_pixels_ == 0) return;
  cv::Mat smooth;
  cv::blur(as_mat(image), smooth, {kBlurPx, kBlurPx});
  double darkest = 0;
  cv::minMaxLoc(smooth, &darkest);
  cv::Mat black = smooth <= std::min(darkest, kBlackest) + kNoise;
  if (is_first)
    black_ = Plane<uint8_t>(image.width, image.height);
  else
    cv::bitwise_and(black, as_mat(black_), black);
  black.copyTo(as_mat(black_));
  if (!is_first && black_pixels_ - cv::countNonZero(black) <= kWorthLooking * black_pixels_) return;
  black = at_border(black);
  black.copyTo(as_mat(black_));
  black_pixels_ = cv::countNonZero(black);
  area_.reset();
  if (black_pixels_ == 0) return;
  auto area = std::make_shared<Plane<uint8_t>>(image.width, image.height);
  cv::dilate(black, as_mat(*area),
             cv::getStructuringElement(cv::MORPH_ELLIPSE, {2 * kMarginPx + 1, 2 * kMarginPx + 1}));
  area_ = std::move(area);
}

std::shared_ptr<const Plane<uint8_t>> BorderMask::mask() const {
  return images_ >= kImagesNeeded ? area_ : nullptr;
}

}  // namespace edgevo
