// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A gyro next to the camera while a run goes on: calibrates itself from rotations that the images show, gives
// rotations with their covariance, and is not used where it contradicts the images.
//
// What it is worth is measured: the rotations that it predicts are compared with those of the images and with
// a camera that goes on turning as before. Errors beyond its covariance make the covariance larger, errors
// that begin at once open it (GyroFilter); a gyro that is worse than to go on turning is not used, and
// calibrated anew.
#include <deque>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "edgevo/gyro/gyro_filter.h"

namespace edgevo {

/// How points turn around the camera, in its axes.
struct RateOfPoints {
  /// At the time, rad/s.
  Eigen::Vector3d rate = Eigen::Vector3d::Zero();
  /// Its change while an image is read, rad/s^2; 0: not known.
  Eigen::Vector3d turning = Eigen::Vector3d::Zero();
};

/// Follows a gyro. One thread at a time.
class GyroAid {
 public:
  /// Nothing is known of the gyro, or `known`, such as from an earlier run; its bias is measured again.
  explicit GyroAid(const std::optional<GyroModel>& known = std::nullopt);

  /// Takes the next sample.
  void add(const GyroSample& sample);
  /// Whether there were any.
  bool has_samples() const { return gyro_.has_samples(); }
  /// Takes a rotation that the images alone show, whose pose is good. Cost: 60 microseconds; until the gyro
  /// is calibrated now and then 10 ms.
  void see(Timestamp begin, Timestamp end, const Eigen::Quaterniond& R, const Eigen::Matrix3d& covariance);

  /// Says that the images show other rotations from now on: their rows are straightened, which they were not
  /// before. How the gyro sits is found anew, and what was found counts little until then.
  void images_changed();

  /// Rotation of the camera between two times; nothing while the gyro is not calibrated, is not used or is
  /// checked after a change, or where samples are missing.
  std::optional<CameraTurn> turn(Timestamp begin, Timestamp end) const;
  /// How points turn around the camera during `readout_s` seconds around `time` (0: of a global shutter, or
  /// not known); nothing as turn().
  std::optional<RateOfPoints> rate_of_points(Timestamp time, double readout_s) const;

  /// The gyro next to the camera; null before it is calibrated.
  const GyroModel* model() const { return filter_ ? &filter_->model() : nullptr; }
  /// Whether turn() may give something.
  bool is_used() const { return filter_ && !checks_change_; }
  /// What was found since the last call, one line each.
  std::vector<std::string> take_reports();
  /// What is known at the end, in words: for the summary of a run. Empty without samples.
  std::string statement() const;

 private:
  // A rotation of the images against what was predicted.
  struct Compared {
    double by_gyro2, by_going_on2;  // squared errors, rad^2
    double sigmas2;                 // of the gyro's, in its covariance
    double noise2, image2;          // variances of the noise of the gyro and of the image, rad^2
  };

  void note_stuck(Timestamp time);
  void note_missing();
  void calibrate();
  void take_fit(const GyroFit& fit);
  void follow(const SeenTurn& seen);
  void note(const std::string& change, double since_s);
  void check_again();
  void compare(const SeenTurn& seen, const CameraTurn& shown, const Eigen::Vector3d& beyond);
  void report_once(const std::string& line, std::string* last);
  void refuse(double gyro2, double going_on2);
  bool is_observed() const { return filter_ && filter_->model().is_observed(); }
  double factor() const;
  std::pair<double, double> errors2() const;
  bool is_noisy() const;
  std::string describe_noise() const;
  std::string describe_missing() const;
  void note_clipped();
  std::string describe_samples() const;

  GyroIntegrator gyro_;
  std::optional<GyroFilter> filter_;
  std::vector<SeenTurn> turns_;  // until it is observed, and since a change
  size_t next_calibration_;
  std::deque<Compared> compared_;
  std::optional<SeenTurn> last_;
  bool was_observed_ = false, checks_change_ = false;
  bool names_noise_ = false, names_missing_ = false, names_clipped_ = false;  // said already
  std::string changed_;  // when and how it has changed last
  std::string stuck_;    // since when it repeats its rates
  std::string fault_;    // why it is not used; empty: none
  std::vector<std::string> reports_;
};

}  // namespace edgevo
