// SPDX-License-Identifier: BSD-3-Clause
#include "camera_doubt.h"

#include <algorithm>
#include <cmath>

#include "assumed_camera.h"
#include "edgevo/core/angle.h"
#include "edgevo/core/output_file.h"
#include "edgevo/core/wrapped_source.h"
#include "edgevo/datasets/describe.h"

namespace edgevo {
namespace {

// Shares of a side by which a principal point is off the middle. Lenses and sensors are centred to some
// hundredths (0.043 at most in nine published cameras). Who cuts images cuts sky or bonnet.
constexpr double kOffCentreX = 0.05, kOffCentreY = 0.25;
// The matrix of scaled images is off by the same share in x and y.
constexpr double kOffByScale = 0.08, kSameShare = 0.05;
// Degrees. Rectilinear lenses end at 115, with distortion at 150, and the widest fisheyes at 280; few people
// look at edges through a telescope.
constexpr double kWidestView = 115, kWidestDistortedView = 150, kWidestFisheyeView = 285, kNarrowestView = 8;
// fx over fy: pixels of sensors are square to some thousandths, and poor calibrations say so to some
// hundredths.
constexpr double kSquare = 1.06;
constexpr double kTangential = 0.03;  // p1 and p2 of a lens are below 0.01
constexpr int kLensGrid = 16;         // cells a side at whose corners distortion is looked at

std::string size_text(double width, double height) {
  return std::to_string(std::lround(width)) + "x" + std::to_string(std::lround(height));
}

std::string doubt_about_centre(const Pinhole& p) {
  const double x = (p.cx + 0.5) / p.width - 0.5, y = (p.cy + 0.5) / p.height - 0.5;
  if (std::abs(x) < kOffCentreX && std::abs(y) < kOffCentreY) return {};
  const double turned_x = (p.cx + 0.5) / p.height - 0.5, turned_y = (p.cy + 0.5) / p.width - 0.5;
  if (std::max(std::abs(turned_x), std::abs(turned_y)) < kOffCentreX)
    return "Width and height seem to be exchanged: the principal point would be in the middle of " +
           size_text(p.height, p.width) + ".";
  if (std::min(std::abs(x), std::abs(y)) > kOffByScale && std::abs(x - y) < kSameShare)
    return "The camera matrix seems to belong to images of about " + size_text(2 * p.cx + 1, 2 * p.cy + 1) +
           ", not " + size_text(p.width, p.height) +
           ", since the principal point would be in the middle of those.";
  return "The principal point (" + fixed(p.cx, 0) + ", " + fixed(p.cy, 0) +
         ") is far from the middle of the " + size_text(p.width, p.height) + " image.";
}

// Whether the lens is described over normalised coordinates, which end before 180 degrees.
bool is_rectilinear(const Camera& camera) {
  return camera.plumb_bob() || std::holds_alternative<RationalModel>(camera.model);
}

double widest_view(const Camera& camera) {
  if (!camera.has_distortion()) return kWidestView;
  return is_rectilinear(camera) ? kWidestDistortedView : kWidestFisheyeView;
}

std::string doubt_about_view(const Camera& camera) {
  const auto [horizontal, vertical] = field_of_view_deg(camera);
  const double view = std::max(horizontal, vertical);
  if (view >= kNarrowestView && view <= widest_view(camera)) return {};
  return "A view of " + fixed(view, 0) + " degrees is unusual: focal length (" +
         fixed(camera.pinhole().fx, 0) + " px) and image size may not belong together.";
}

std::string doubt_about_pixels(const Pinhole& p) {
  if (std::max(p.fx / p.fy, p.fy / p.fx) < kSquare) return {};
  return "fx and fy differ by " + fixed(100 * (std::max(p.fx / p.fy, p.fy / p.fx) - 1), 0) +
         " %: pixels are square, unless the images were stretched.";
}

bool shows_all(const Camera& camera) {
  for (int i = 0; i <= kLensGrid; ++i)
    for (int j = 0; j <= kLensGrid; ++j) {
      const Eigen::Vector2d px(i * (camera.width - 1.0) / kLensGrid, j * (camera.height - 1.0) / kLensGrid);
      if (!camera.unproject(px)) return false;
    }
  return true;
}

// Distortion that narrows the view: that of lenses does by some per cent.
std::string doubt_about_narrowing(const Camera& camera) {
  constexpr double kNarrowed = 1.25;
  const double without = field_of_view_deg(Camera(camera.pinhole())).first;
  const double with = field_of_view_deg(camera).first;
  if (without <= kNarrowed * with) return {};
  return "The distortion narrows the view from " + fixed(without, 0) + " to " + fixed(with, 0) +
         " degrees, which that of a lens does not.";
}

std::string doubt_about_tangential(const Distortion& d) {
  if (std::max(std::abs(d.p1), std::abs(d.p2)) <= kTangential) return {};
  return "p1 and p2 (" + fixed(d.p1, 4) + ", " + fixed(d.p2, 4) +
         ") are larger than those of any lens: are the coefficients those of a fisheye model, or in another "
         "order?";
}

// A fisheye's image may be a circle within the frame; its formula has to reach the nearest border.
std::string doubt_about_fisheye(const Camera& camera) {
  const Pinhole p = camera.pinhole();
  const double reach = std::min({p.cx, p.cy, p.width - 1 - p.cx, p.height - 1 - p.cy});
  for (const auto& [x, y] : {std::pair(1, 0), std::pair(-1, 0), std::pair(0, 1), std::pair(0, -1)})
    if (!camera.unproject({p.cx + x * reach, p.cy + y * reach}))
      return "The formula of the lens ends at " + fixed(deg(camera.max_angle()), 0) +
             " degrees from the axis, within the image: the calibration does not reach further, or belongs "
             "to "
             "other images.";
  return {};
}

std::string doubt_about_lens(const Camera& camera) {
  if (!camera.has_distortion()) return {};
  if (!is_rectilinear(camera)) return doubt_about_fisheye(camera);
  const auto* rational = std::get_if<RationalModel>(&camera.model);
  const std::string tangential =
      doubt_about_tangential(rational ? rational->distortion.plumb_bob : camera.distortion());
  if (!tangential.empty()) return tangential;
  if (shows_all(camera)) return doubt_about_narrowing(camera);
  return "The distortion folds the image over before its border: the calibration does not reach that far, or "
         "belongs to other images.";
}

class DoubtedSource : public WrappedSource {
 public:
  DoubtedSource(std::unique_ptr<ImageSource> inner, std::string doubt)
      : WrappedSource(std::move(inner)), doubt_(std::move(doubt)) {}

  std::vector<InputDecision> decisions() const override {
    std::vector<InputDecision> all = inner().decisions();
    for (InputDecision& d : all)
      if (d.subject == "camera") {
        d.doubt += (d.doubt.empty() ? "" : " ") + doubt_;
        return all;
      }
    const Pinhole p = inner().camera().pinhole();
    all.push_back({"camera",
                   "fx " + fixed(p.fx, 1) + ", fy " + fixed(p.fy, 1) + ", cx " + fixed(p.cx, 1) + ", cy " +
                       fixed(p.cy, 1) + " px",
                   "for " + size_text(p.width, p.height), doubt_});
    return all;
  }

 private:
  std::string doubt_;
};

}  // namespace

std::string doubt_about(const Camera& camera, bool is_assumed) {
  std::string all;
  for (const std::string& doubt : {doubt_about_centre(camera.pinhole()), doubt_about_view(camera),
                                   doubt_about_pixels(camera.pinhole()), doubt_about_lens(camera)})
    if (!doubt.empty()) all += doubt + " ";
  if (all.empty()) return all;
  return all + (is_assumed ? "Check --fov, or give a calibration with --camera."
                           : "Check the camera file (edgevo calibrate --chessboard makes one).");
}

std::unique_ptr<ImageSource> with_camera_doubt(std::unique_ptr<ImageSource> source) {
  if (!knows_camera(*source)) return source;
  std::string doubt = doubt_about(source->camera(), assumes_camera(*source));
  if (doubt.empty()) return source;
  return std::make_unique<DoubtedSource>(std::move(source), std::move(doubt));
}

}  // namespace edgevo
