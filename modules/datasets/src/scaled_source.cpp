// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/datasets/scaled_source.h"

#include <cmath>
#include <opencv2/imgproc.hpp>

#include "camera_fit.h"
#include "edgevo/core/error.h"
#include "edgevo/core/output_file.h"
#include "edgevo/core/wrapped_source.h"
#include "edgevo/datasets/open_source.h"

namespace edgevo {
namespace {

// Accuracy and time were measured at up to 1241x376, 470,000 pixels. A third more bring nothing, and twice as
// many cost 2.5 times the time (lab 2026-11-26_working_size).
constexpr double kMeasuredPixels = 480000;
// Times as many stay as they are: a resampling by less than a fifth blurs more than it saves.
constexpr double kWithinReach = 1.5;
constexpr int kMeasuredWidth = 1241;
constexpr int kMinSide = 16;  // below this no pyramid level remains

template <class T>
std::vector<T> scaled(const std::vector<T>& pixels, const cv::Size& size, const cv::Size& wanted) {
  if (pixels.empty()) return {};
  std::vector<T> small(size_t(wanted.area()));
  const cv::Mat from(size, cv::DataType<T>::type, const_cast<T*>(pixels.data()));
  cv::Mat to(wanted, cv::DataType<T>::type, small.data());
  cv::resize(from, to, wanted, 0, 0, cv::INTER_AREA);
  return small;
}

GrayImage scaled(const GrayImage& image, int width, int height) {
  const cv::Size size(image.width, image.height), wanted(width, height);
  return {width, height, scaled(image.pixels, size, wanted), scaled(image.values, size, wanted), image.scale};
}

std::string size_of(const Pinhole& p) { return std::to_string(p.width) + "x" + std::to_string(p.height); }

class ScaledSource : public WrappedSource {
 public:
  ScaledSource(std::unique_ptr<ImageSource> inner, int width, int height, std::string reason)
      : WrappedSource(std::move(inner)),
        camera_(scaled_camera(this->inner().camera(), width, height)),
        reason_(std::move(reason)) {}

  const Camera& camera() const override { return camera_; }
  std::vector<std::pair<std::string, std::string>> details() const override {
    auto all = inner().details();
    all.emplace_back(kScaled, "from " + size_of(inner().camera().pinhole()) + " to " +
                                  size_of(camera_.pinhole()) + reason_);
    return all;
  }

  std::optional<Frame> next() override {
    auto frame = inner().next();
    if (!frame) return std::nullopt;
    frame->image = scaled(frame->image, camera_.pinhole().width, camera_.pinhole().height);
    frame->image_path.clear();
    return frame;
  }

 private:
  Camera camera_;
  std::string reason_;
};

}  // namespace

double usual_image_scale(int width, int height) {
  const double pixels = double(width) * height;
  const double by_pixels = pixels > kWithinReach * kMeasuredPixels ? std::sqrt(kMeasuredPixels / pixels) : 1;
  const double by_width = width > 2 * kMeasuredWidth ? double(kMeasuredWidth) / width : 1;
  return std::min(by_pixels, by_width);
}

std::unique_ptr<ImageSource> scale_images(std::unique_ptr<ImageSource> inner, double wanted) {
  const Pinhole p = inner->camera().pinhole();
  const bool is_auto = wanted == kAutomaticScale;
  const double scale = is_auto ? usual_image_scale(p.width, p.height) : wanted;
  if (scale == 1) return inner;
  if (!(scale >= 0.01 && scale < 1))
    throw InputError("--image-scale " + fixed(scale, 3), "is out of range", "give 0.01 to 1");
  const int width = int(std::lround(scale * p.width)), height = int(std::lround(scale * p.height));
  if (std::min(width, height) < kMinSide)
    throw InputError("--image-scale " + fixed(scale, 3), "is too small for images of " + size_of(p),
                     "give a larger scale");
  return std::make_unique<ScaledSource>(
      std::move(inner), width, height,
      is_auto ? ": they cost half the time; sharp images are more accurate with --image-scale 1" : "");
}

}  // namespace edgevo
