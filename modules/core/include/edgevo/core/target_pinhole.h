// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The pinhole that the images of a lens are rectified to.
//
// Its focal length is up to 1.25 times that of the lens on its axis, so that the middle of the image keeps
// its sharpness: interpolation at the same or a shorter one would blur it. It is less where the image would
// have more than 720,000 pixels, but at least that of the lens. Its sides reach as far as the lens sees along
// its rows and columns, but no further than kWidestView: towards the border a pinhole magnifies the image by
// up to 1 / cos^2 of the angle (4 at 60 degrees), which costs pixels and shows nothing new.
#include <optional>

#include "edgevo/core/camera.h"
#include "edgevo/core/input_decision.h"

namespace edgevo {

/// Degrees from side to side that the usual pinhole shows at most.
constexpr double kWidestView = 120;

/// What is requested of the pinhole; nothing: the usual one.
struct TargetRequest {
  /// Degrees from side to side that it shows at most, 1 to 150, instead of kWidestView.
  std::optional<double> view_deg;
  /// Size of its images, pixels; 0: as the view needs. Another size scales the focal length such that the
  /// view fills the image, and cuts off what does not fit.
  int width = 0, height = 0;

  /// Whether nothing is requested.
  bool is_empty() const { return !view_deg && width == 0; }
};

/// How far a camera sees from its axis to the four sides, along row and column of the principal point,
/// radians.
struct ViewAngles {
  /// To each side; the image reaches half a pixel beyond the centres of its border pixels.
  double left = 0, right = 0, up = 0, down = 0;
  /// From side to side, radians.
  double horizontal() const { return left + right; }
  /// From top to bottom, radians.
  double vertical() const { return up + down; }
};

/// What the image and the range of the lens let it see. Cost: some 240 projections.
ViewAngles view_angles(const Camera& camera);

/// The pinhole for the images of a camera. For a lens without or with plumb-bob distortion and an empty
/// request it is that of the camera file, of the same size.
Pinhole target_pinhole(const Camera& camera, const TargetRequest& request = {});

/// Share of the pixels with a ray, 0 to 1, that `target` does not show. Cost: some 4,000 inversions.
double cropped_share(const Camera& camera, const Pinhole& target);

/// What the pinhole is and what it cuts off, subject "rectified".
InputDecision describe_target(const Camera& camera, const Pinhole& target);

}  // namespace edgevo
