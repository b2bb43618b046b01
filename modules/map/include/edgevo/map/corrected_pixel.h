// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// What is measured in an image when another correction of the camera is applied to it
// (edges/image_correction.h).
#include <Eigen/Core>

#include "edgevo/core/rectification.h"
#include "edgevo/core/se3.h"
#include "edgevo/edges/image_motion.h"

namespace edgevo {

/// New position of a pixel when an image of the given motion that was corrected by `before` is corrected by
/// `now` instead.
Eigen::Vector2d correct_pixel(const Rectification& rectification, const ImageCorrection& before,
                              const ImageCorrection& now, const ImageMotion& motion,
                              const Eigen::Vector2d& px);
/// New unit normal of the edge at `px` when an image corrected by `before` is corrected by `now` instead.
Eigen::Vector2d correct_normal(const Rectification& rectification, const ImageCorrection& before,
                               const ImageCorrection& now, const ImageMotion& motion,
                               const Eigen::Vector2d& px, const Eigen::Vector2d& normal);
/// The motion that moves an image of the same depths as T does where all normalised points are `image_ratio`
/// times as far from the centre, to first order: a turn across the image and a step sideways change by it, a
/// roll and a step forwards do not.
SE3 correct_motion(const SE3& T, double image_ratio);

}  // namespace edgevo
