// SPDX-License-Identifier: BSD-3-Clause
#include "border_mask.h"

#include <algorithm>
#include <opencv2/imgproc.hpp>

#include "edgevo/edges/opencv_view.h"

namespace edgevo {
namespace {

constexpr int kBlurPx = 9;               // side of the mean filter: sensor noise, JPEG blocks
constexpr double kDarkestShare = 0.001;  // share of the pixels that defines the darkest level
constexpr int kAboveDarkest = 5;         // gray levels of noise that remain after the blur
// Largest gray level of black: 16 in video, plus an offset. Anything lighter belongs to the scene.
constexpr int kBlackest = 20;
constexpr double kMinAreaShare = 0.04;  // of the image; smaller areas do little harm
// Areas are searched again once this share of the dark pixels was lit: noise lights a pixel now and then.
constexpr double kWorthLooking = 0.01;
// The outline is blurred by this filter, the lens, the undistortion and the filter of the gradient.
constexpr int kMarginPx = kBlurPx / 2 + 6;
// One image is not enough to distinguish a black border from a dark corner of the scene.
constexpr int kImagesNeeded = 20;

// Gray level that `share` of the pixels do not exceed.
int level_of_share(const cv::Mat& image, double share) {
  int count[256] = {};
  for (int y = 0; y < image.rows; ++y)
    for (int x = 0; x < image.cols; ++x) ++count[image.at<uint8_t>(y, x)];
  int level = 0, below = count[0];
  while (level < 255 && below < share * double(image.total())) below += count[++level];
  return level;
}

bool reaches_border(const cv::Rect& box, const cv::Size& image) {
  return box.x == 0 || box.y == 0 || box.br().x == image.width || box.br().y == image.height;
}

}  // namespace

void BorderMask::add(const ImageView<uint8_t>& image) {
  if (is_gone_) return;
  ++images_;
  cv::Mat smooth;
  cv::blur(as_mat(image), smooth, {kBlurPx, kBlurPx});
  const cv::Mat dark = smooth <= std::min(level_of_share(smooth, kDarkestShare), kBlackest) + kAboveDarkest;
  const bool is_first = dark_.empty();
  if (is_first) dark_ = Plane<uint8_t>(image.width, image.height);
  cv::Mat kept = as_mat(dark_);
  if (is_first)
    dark.copyTo(kept);
  else
    cv::bitwise_and(kept, dark, kept);
  const int pixels = cv::countNonZero(kept);
  if (!is_first && dark_pixels_ - pixels <= kWorthLooking * dark_pixels_) return;
  dark_pixels_ = pixels;
  find_areas();
}

void BorderMask::find_areas() {
  const cv::Mat dark = as_mat(dark_);
  cv::Mat labels, boxes, centres;
  const int count = cv::connectedComponentsWithStats(dark, labels, boxes, centres, 4);
  auto mask = std::make_shared<Plane<uint8_t>>(dark_.width(), dark_.height());
  cv::Mat marked = as_mat(*mask);
  marked.setTo(0);
  is_gone_ = true;
  for (int i = 1; i < count; ++i) {
    const cv::Rect box(boxes.at<int>(i, cv::CC_STAT_LEFT), boxes.at<int>(i, cv::CC_STAT_TOP),
                       boxes.at<int>(i, cv::CC_STAT_WIDTH), boxes.at<int>(i, cv::CC_STAT_HEIGHT));
    if (boxes.at<int>(i, cv::CC_STAT_AREA) < kMinAreaShare * double(dark.total()) ||
        !reaches_border(box, dark.size()))
      continue;
    marked.setTo(255, labels == i);
    is_gone_ = false;
  }
  areas_.reset();
  if (is_gone_) return;
  cv::dilate(marked, marked,
             cv::getStructuringElement(cv::MORPH_ELLIPSE, {2 * kMarginPx + 1, 2 * kMarginPx + 1}));
  areas_ = std::move(mask);
}

std::shared_ptr<const Plane<uint8_t>> BorderMask::mask() const {
  return images_ >= kImagesNeeded && areas_ ? areas_ : nullptr;
}

}  // namespace edgevo
