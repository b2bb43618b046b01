// SPDX-License-Identifier: BSD-3-Clause
#include "camera_doubt.h"

#include <algorithm>
#include <cmath>

#include "assumed_camera.h"
#include "edgevo/core/output_file.h"
#include "edgevo/core/wrapped_source.h"
#include "edgevo/datasets/describe.h"

namespace edgevo {
namespace {

// Shares of a side by which a principal point is off the middle. Lenses and sensors are centred to some
// hundredths; images that were cut on one side may be off by more.
constexpr double kOffCentreX = 0.15, kOffCentreY = 0.25;
// The matrix of scaled images is off by the same share in x and y.
constexpr double kOffByScale = 0.08, kSameShare = 0.05;
// Degrees. Rectilinear lenses end at 115, and few people look at edges through a telescope.
constexpr double kWidestView = 115, kWidestDistortedView = 150, kNarrowestView = 8;
constexpr double kSquare = 1.25;      // fx over fy: video of other than square pixels has up to 1.2
constexpr double kTangential = 0.03;  // p1 and p2 of a lens are below 0.01
constexpr int kLensGrid = 16;         // cells a side at whose corners distortion is looked at

std::string size_text(double width, double height) {
  return std::to_string(std::lround(width)) + "x" + std::to_string(std::lround(height));
}

std::string doubt_about_centre(const Pinhole& p) {
  const double x = (p.cx + 0.5) / p.width - 0.5, y = (p.cy + 0.5) / p.height - 0.5;
  if (std::min(std::abs(x), std::abs(y)) > kOffByScale && std::abs(x - y) < kSameShare)
    return "The camera matrix seems to belong to images of about " + size_text(2 * p.cx + 1, 2 * p.cy + 1) +
           ", not " + size_text(p.width, p.height) +
           ", since the principal point would be in the middle of those.";
  if (std::abs(x) < kOffCentreX && std::abs(y) < kOffCentreY) return {};
  return "The principal point (" + fixed(p.cx, 0) + ", " + fixed(p.cy, 0) +
         ") is far from the middle of the " + size_text(p.width, p.height) + " image.";
}

std::string doubt_about_view(const Camera& camera) {
  const auto [horizontal, vertical] = field_of_view_deg(camera);
  const double view = std::max(horizontal, vertical);
  const double widest = camera.has_distortion() ? kWidestDistortedView : kWidestView;
  if (view >= kNarrowestView && view <= widest) return {};
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

std::string doubt_about_lens(const Camera& camera) {
  const Distortion d = camera.distortion();
  if (std::max(std::abs(d.p1), std::abs(d.p2)) > kTangential)
    return "p1 and p2 (" + fixed(d.p1, 4) + ", " + fixed(d.p2, 4) +
           ") are larger than those of any lens: are the coefficients those of a fisheye model, or in "
           "another "
           "order?";
  if (!camera.has_distortion()) return {};
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

std::string doubt_about(const Camera& camera) {
  std::string all;
  for (const std::string& doubt : {doubt_about_centre(camera.pinhole()), doubt_about_view(camera),
                                   doubt_about_pixels(camera.pinhole()), doubt_about_lens(camera)})
    if (!doubt.empty()) all += doubt + " ";
  return all.empty() ? all : all + "Check the camera file (edgevo calibrate --chessboard makes one).";
}

std::unique_ptr<ImageSource> with_camera_doubt(std::unique_ptr<ImageSource> source) {
  if (!knows_camera(*source)) return source;
  std::string doubt = doubt_about(source->camera());
  if (doubt.empty()) return source;
  return std::make_unique<DoubtedSource>(std::move(source), std::move(doubt));
}

}  // namespace edgevo
