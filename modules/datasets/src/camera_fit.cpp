// SPDX-License-Identifier: BSD-3-Clause
#include "camera_fit.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "edgevo/core/error.h"
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
  constexpr double kLeastChange = 0.05;
  if (a == b) return true;
  const double x_low = (b.first - 1.0) / a.first, x_high = (b.first + 1.0) / a.first;
  const double y_low = (b.second - 1.0) / a.second, y_high = (b.second + 1.0) / a.second;
  return std::max(x_low, y_low) <= std::min(x_high, y_high) &&
         std::abs(double(b.first) / a.first - 1) > kLeastChange;
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
  CameraFit(const std::string& path, CameraText text, const SeenImages& images)
      : path_(path),
        text_(std::move(text)),
        size_(images.width, images.height),
        turns_(images.quarter_turns),
        unturned_(turns_ % 2 ? swapped(size_) : size_) {
    add_phrase(&decision_.value, text_.note);
    decision_.doubt = text_.doubt;
  }

  Camera camera() {
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
                               : "give the calibration of these images (--camera)");
  }

  std::string path_;
  CameraText text_;
  Size size_;
  int turns_;
  Size unturned_;
  InputDecision decision_{"camera", "", "", ""};
};

// x' = -y, y' = x: the new right is the old up.
Camera turned_clockwise(const Camera& camera) {
  const Pinhole p = camera.pinhole();
  const Distortion d = camera.distortion();
  return Camera({p.fy, p.fx, p.height - 1 - p.cy, p.cx, p.height, p.width}, {d.k1, d.k2, d.p2, -d.p1, d.k3});
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

Camera scaled_camera(const Camera& camera, int width, int height) {
  const Pinhole p = camera.pinhole();
  const double x = double(width) / p.width, y = double(height) / p.height;
  Camera small = camera;
  small.set_pinhole({p.fx * x, p.fy * y, (p.cx + 0.5) * x - 0.5, (p.cy + 0.5) * y - 0.5, width, height});
  return small;
}

Camera turned_camera(const Camera& camera, int quarter_turns) {
  Camera turned = camera;
  for (int i = 0; i < quarter_turns; ++i) turned = turned_clockwise(turned);
  return turned;
}

CameraText read_camera_text(const std::string& path) { return parse_camera_text(read_text_file(path), path); }

Camera camera_of_file(const std::string& path, SeenImages images, std::vector<InputDecision>* decisions) {
  CameraText text = read_camera_text(path);
  find_size(text.camera.width, text.camera.height, &images);
  CameraFit fit(path, std::move(text), images);
  Camera camera = fit.camera();
  if (!fit.decision().value.empty()) decisions->push_back(fit.decision());
  return camera;
}

}  // namespace edgevo
