// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// How a gyro sits next to its camera, from rotations that the images show: nothing of it need be known.
//
// First both angular velocities are compared for each offset of the clocks; the rotation between them is that
// of Wahba's problem (Kabsch, Acta Cryst. A 32, 1976). From there all unknowns are found by least squares,
// with what gyros have as the prior: about an axis that the camera never turned around nothing is known then,
// and the covariance says so.
#include <Eigen/Geometry>
#include <optional>
#include <string>
#include <vector>

#include "edgevo/gyro/gyro_model.h"

namespace edgevo {

/// A rotation that the images show.
struct SeenTurn {
  /// Times of the two images, seconds in GyroIntegrator's count.
  double begin = 0, end = 0;
  /// p_end = R p_begin for points at infinity.
  Eigen::Quaterniond R = Eigen::Quaterniond::Identity();
  /// Covariance of delta in R <- exp(delta) R.
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
};

/// What a comparison of gyro and images showed.
struct GyroFit {
  /// What may be found.
  enum class Kind {
    /// The camera has not turned enough for an answer.
    kUnknown,
    /// The gyro turns with the camera: `model` holds.
    kRelated,
    /// It turns with the camera, but its axes are left-handed: one is mirrored, or two are swapped.
    kMirrored,
    /// The same, but it is not sure yet.
    kPerhapsMirrored,
    /// It turns with the camera at other rates: `times` those of the images.
    kOtherRates,
    /// It turns as the camera does, but `offset_s` later or earlier: its clock is another one.
    kOtherClock,
    /// The camera turned, and the gyro did not turn with it.
    kUnrelated,
  };
  /// What was found.
  Kind kind = Kind::kUnknown;
  /// The gyro next to the camera, of kRelated.
  GyroModel model;
  /// Rates of the images over those of the gyro, of kOtherRates and kRelated.
  double times = 1;
  /// Time of the gyro less that of the images, seconds, of kOtherClock.
  double offset_s = 0;
};

/// Compares a gyro with turns of the images. Cost: 10 ms for 300 turns.
GyroFit fit_gyro(const GyroIntegrator& gyro, const std::vector<SeenTurn>& turns);

/// Least squares of all unknowns from `start`, whose covariance is the prior.
GyroModel refine_gyro(const GyroIntegrator& gyro, const std::vector<SeenTurn>& turns, const GyroModel& start);

}  // namespace edgevo
