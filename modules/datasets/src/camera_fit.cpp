// SPDX-License-Identifier: BSD-3-Clause
#include "camera_fit.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "assumed_camera.h"
#include "edgevo/core/error.h"
#include "edgevo/core/output_file.h"
#include "edgevo/mrpt_bridge/image_file.h"
#include "text_file.h"

namespace edgevo {
namespace {

using Size = std::pair<int, int>;  // width, height

std::string to_text(Size size) { return std::to_string(size.first) + "x" + std::to_string(size.second); }

Size swapped(Size size) { return {size.second, size.first}; }

Size size_of(const Camera& camera) { return {camera.width, camera.height}; }

// {0, 0} for an image that cannot be read: its frame will say why.
Size size_of_file(const std::string& path) {
  try {
    const GrayImage image = read_gray_image(path);
    return {image.width, image.height};
  } catch (const InputError&) {
    return {0, 0};
  }
}

// Whether images of size `b` may be ones of size `a` that were scaled, both sides being rounded. A size that
// differs by a few pixels is another crop.
bool is_scaled(Size a, Size b) {
  constexpr double kMinChange = 0.05;
  if (a == b) return true;
  const double x_low = (b.first - 1.0) / a.first, x_high = (b.first + 1.0) / a.first;
  const double y_low = (b.second - 1.0) / a.second, y_high = (b.second + 1.0) / a.second;
  return std::max(x_low, y_low) <= std::min(x_high, y_high) &&
         std::abs(double(b.first) / a.first - 1) > kMinChange;
}

// Whether the sides differ by their rounding only.
bool is_rounded(Size a, Size b) {
  return std::abs(a.first - b.first) <= 1 && std::abs(a.second - b.second) <= 1;
}

// Distance of the principal point from the middle of images of that size, as a share of the sides.
double off_centre(const Pinhole& p, Size size) {
  return std::hypot(p.cx / size.first - 0.5, p.cy / size.second - 0.5);
}

void add_phrase(std::string* list, const std::string& item, const char* separator = "; ") {
  if (!item.empty()) *list += (list->empty() ? "" : separator) + item;
}

class CameraFit {
 public:
  CameraFit(const CameraFile& file, CameraText text, const SeenImages& images)
      : path_(file.path),
        scale_(file.scale),
        text_(std::move(text)),
        size_(images.width, images.height),
        turns_(images.quarter_turns),
        unturned_(turns_ % 2 ? swapped(size_) : size_) {
    add_phrase(&decision_.value, text_.note);
    decision_.doubt = text_.doubt;
  }

  Camera camera() {
    if (scale_ > 0) apply_scale();
    if (size_.first > 0) {
      if (!text_.has_size()) take_size();
      fit();
    } else if (!text_.has_size()) {
      throw InputError(path_, "the image size is missing", "give image_width and image_height in pixels");
    }
    text_.camera.check(path_);
    return text_.camera;
  }
  const InputDecision& decision() const { return decision_; }

 private:
  // What the user says about the size of the images.
  void apply_scale() {
    const Pinhole p = text_.camera.pinhole();
    text_.camera.set_pinhole({scale_ * p.fx, scale_ * p.fy, scale_ * (p.cx + 0.5) - 0.5,
                              scale_ * (p.cy + 0.5) - 0.5, int(std::lround(scale_ * p.width)),
                              int(std::lround(scale_ * p.height))});
    add_phrase(&decision_.value, "scaled by " + fixed(scale_, 4) + ", as --camera-scale says");
    if (!text_.has_size() || size_.first == 0) return;
    for (const Size& size : {size_, unturned_})
      if (is_rounded(size_of(text_.camera), size)) return set_size(size);
    throw InputError(path_,
                     "at --camera-scale " + fixed(scale_, 4) + " it is for images of " +
                         to_text(size_of(text_.camera)) + ", but these have " + to_text(size_),
                     "correct the scale, or calibrate these images if they were cut out of larger ones");
  }
  void take_size() {
    const Pinhole p = text_.camera.pinhole();
    const bool turned = turns_ % 2 && off_centre(p, unturned_) < off_centre(p, size_);
    set_size(turned ? unturned_ : size_);
    add_phrase(&decision_.value, "for " + to_text(size_of(text_.camera)));
    add_phrase(&decision_.reason, "the file has no image size; that of the images is taken");
    text_.camera.check(path_ + ", for images of " + to_text(size_));
    constexpr double kCentred = 0.1;  // those of the cameras of known data sets are within 0.06
    if (off_centre(p, size_of(text_.camera)) > kCentred)
      add_phrase(
          &decision_.doubt,
          "Their size may not be that of the calibration, whose principal point is far from their middle: "
          "write the size into the file.",
          " ");
  }
  void set_size(Size size) {
    text_.camera.width = size.first;
    text_.camera.height = size.second;
  }
  void fit() {
    const Size own = size_of(text_.camera);
    const bool is_for_turned = turns_ % 2 && own.first != own.second && is_scaled(own, size_);
    if (turns_ == 0 || is_for_turned) {
      if (!is_scaled(own, size_)) refuse();
      scale(size_);
      return;
    }
    if (!is_scaled(own, unturned_)) refuse();
    scale(unturned_);
    text_.camera = turned_camera(text_.camera, turns_);
    add_phrase(&decision_.value, "turned by " + std::to_string(90 * turns_) + " degrees with the images");
    add_phrase(&decision_.reason, turns_ % 2 ? "the file is for " + to_text(own)
                                             : "the file is taken to be for unturned images");
    if (own.first == own.second || turns_ == 2)
      add_phrase(&decision_.doubt, "If the camera file was made from turned images, it is now turned twice.",
                 " ");
  }
  void scale(Size size) {
    const Size own = size_of(text_.camera);
    if (own == size) return;
    text_.camera = scaled_camera(text_.camera, size.first, size.second);
    add_phrase(&decision_.value, "scaled from " + to_text(own) + " to " + to_text(size));
    add_phrase(&decision_.reason, "the images have the shape of those of " + path_);
    add_phrase(&decision_.doubt,
               "That is wrong if they were cut out of larger images instead of scaled: then calibrate them.",
               " ");
  }
  [[noreturn]] void refuse() const {
    const Size own = size_of(text_.camera);
    const bool is_turned = is_scaled(swapped(own), size_);
    throw InputError(path_,
                     "the image is " + to_text(size_) + ", but the camera model is for " + to_text(own) +
                         (is_turned ? ": the images are turned" : ", of another shape"),
                     is_turned ? "turn the images back, or give the calibration of turned ones (--camera)"
                               : "give the calibration of these images (--camera); of images cut out of "
                                 "larger ones, with their size and cx, cy less the corner");
  }

  std::string path_;
  double scale_;
  CameraText text_;
  Size size_;
  int turns_;
  Size unturned_;
  InputDecision decision_{"camera", "", "", ""};
};

// What the images' EXIF data say against the focal length. Both agree to some per cent, as manufacturers take
// "35 mm equivalent" over the diagonal or the width.
std::string doubt_by_exif(const Camera& camera, const SeenImages& images) {
  constexpr double kAgree = 1.25;
  const bool is_rectilinear = camera.plumb_bob() || std::holds_alternative<RationalModel>(camera.model);
  if (!is_rectilinear) return {};
  const std::optional<double> exif = exif_focal_length_px(images);
  if (!exif) return {};
  const Pinhole p = camera.pinhole();
  const double f = std::sqrt(p.fx * p.fy);
  if (std::max(f / *exif, *exif / f) < kAgree) return {};
  return "The EXIF data of the images say a focal length of about " + fixed(*exif, 0) + " px, not " +
         fixed(f, 0) + ": the file is of another camera or zoom, or the images were cut out of larger ones.";
}

}  // namespace

SeenImages seen_images(const std::vector<std::string>& paths) {
  if (paths.empty()) return {};
  return {{paths.front(), paths[paths.size() / 2], paths.back()}, 0, 0, 0};
}

void find_size(int width, int height, SeenImages* images) {
  if (images->width > 0 || images->paths.empty()) return;
  Size size = size_of_file(images->paths.front());
  if (size != Size(width, height)) {
    std::map<Size, int> votes{{size, 1}};
    for (size_t i = 1; i < images->paths.size(); ++i) {
      const Size other = size_of_file(images->paths[i]);
      if (size.first == 0 || (other.first > 0 && ++votes[other] > 1)) size = other;
    }
  }
  images->width = size.first, images->height = size.second;
}

Camera camera_of_file(const CameraFile& file, SeenImages images, std::vector<InputDecision>* decisions) {
  CameraText text = read_camera_text(file.path, file.sensor);
  find_size(text.camera.width, text.camera.height, &images);
  CameraFit fit(file, std::move(text), images);
  Camera camera = fit.camera();
  InputDecision decision = fit.decision();
  if (const std::string doubt = doubt_by_exif(camera, images); !doubt.empty()) {
    if (decision.value.empty()) decision.value = "that of " + file.path;
    add_phrase(&decision.doubt, doubt, " ");
  }
  if (!decision.value.empty()) decisions->push_back(decision);
  return camera;
}

}  // namespace edgevo
