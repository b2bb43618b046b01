// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Lenses as files state them: a name, coefficients in the order of the paper or of OpenCV, and focal lengths
// of the model's own formula. Those of Camera are on the axis (core/camera_models.h).
#include <optional>
#include <string>
#include <vector>

#include "edgevo/core/camera.h"

namespace edgevo {

/// The lens models of files. kUnified is kExtendedUnified with beta 1.
enum class LensKind {
  kPinhole,
  kPlumbBob,
  kRational,
  kKannalaBrandt,
  kFov,
  kUnified,
  kExtendedUnified,
  kDoubleSphere,
  kOmni
};

/// A lens as a file states it.
struct StatedLens {
  LensKind kind = LensKind::kPinhole;
  /// Focal lengths as the formula of the model has them, and principal point; pixels.
  Intrinsics intrinsics;
  /// In the order of coefficient_names().
  std::vector<double> coefficients;
};

/// "distortion_model" of ROS for plumb_bob, rational_polynomial and equidistant, else the usual short name.
std::string name_of(LensKind kind);

/// The lens of a name that programs use for it, in any case; nullopt if there is none.
std::optional<LensKind> lens_of_name(const std::string& name);

/// All names that lens_of_name() knows, for messages.
const std::vector<std::string>& lens_names();

/// Names of the coefficients in their order, such as k1, k2, p1, p2, k3.
std::vector<std::string> coefficient_names(LensKind kind);

/// The model of a stated lens. Missing coefficients and zeros at the end of too many count as zero where the
/// formula allows it: plumb-bob has 0, 4 or 5, rational 8, 12 or 14 (of which the last two, a tilted sensor,
/// must be 0), omni 1 or 5. Throws InputError, opened by `where`, that names the coefficients.
CameraModel model_of(StatedLens lens, const std::string& where);

/// The inverse of model_of(). A rational lens without thin prism has 8 coefficients, plumb-bob 5.
StatedLens stated_lens(const CameraModel& model);

}  // namespace edgevo
