// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/visp_bridge/servo_feed.h"

#include <algorithm>
#include <cmath>

#include "edgevo/alignment/reference.h"
#include "edgevo/core/error.h"
#include "edgevo/core/output_file.h"
#include "edgevo/visp_bridge/conversions.h"

namespace edgevo {
namespace {

constexpr double kClockTolerance_s = 1;  // images further in the future have another clock

SE3 in_metres(const SE3& T, double metres_per_unit) {
  return {T.rotation(), metres_per_unit * T.translation()};
}

vpMatrix to_visp_metres(const Matrix6d& covariance, double metres_per_unit) {
  Vector6d unit = Vector6d::Ones();
  unit.head<3>().setConstant(metres_per_unit);
  const Matrix6d scaled = unit.asDiagonal() * covariance * unit.asDiagonal();
  vpMatrix m(6, 6);
  for (unsigned r = 0; r < 6; ++r)
    for (unsigned c = 0; c < 6; ++c) m[r][c] = scaled(r, c);
  return m;
}

std::string too_old_because(double age_s, const ServoFeedOptions& options) {
  if (age_s > options.stale_after_s) return "stale: the newest pose is " + std::to_string(age_s) + " s old";
  if (age_s < -kClockTolerance_s)
    return "the newest image is from the future: images and loop must use one clock";
  return {};
}

std::string not_usable_because(const NewestPose& view, double age_s, const ServoFeedOptions& options) {
  if (view.frame_index < 0) return "no image has been processed yet";
  if (!view.T_cam_map)
    return std::string(to_string(view.state)) + (view.note.empty() ? "" : ": " + view.note);
  if (view.p_right < options.min_p_right)
    return "doubtful, p_right " + fixed(view.p_right, 2) + (view.note.empty() ? "" : ": " + view.note);
  return too_old_because(age_s, options);
}

}  // namespace

void ServoFeed::publish(const NewestPose& view, const KeptMapPose& kept) {
  const std::lock_guard<std::mutex> lock(mutex_);
  const bool other_segment = view.reference && newest_.reference && view.segment != newest_.segment;
  const bool other_camera = view.reference && newest_.reference &&
                            !view.reference->camera.applied.has_lens_of(newest_.reference->camera.applied);
  if (other_segment || other_camera) ++map_version_;
  if (other_segment && scale_.is_metric()) {
    scale_.metres_per_unit *= view.odom_scale / last_odom_scale_;
    scale_.relative_sigma = std::hypot(scale_.relative_sigma, view.scale_sigma);
  }
  if (view.reference) last_odom_scale_ = view.odom_scale;
  const double step = seconds_between(newest_.time, view.time);
  const bool follows = view.T_cam_map && newest_.T_cam_map && !other_segment && !other_camera && step > 0 &&
                       step <= options_.max_step_s;
  step_s_ = follows ? step : 0;
  velocity_ = follows ? Vector6d((*view.T_cam_map * newest_.T_cam_map->inverse()).log() / step)
                      : Vector6d(Vector6d::Zero());
  // Without a map the last one is kept, since tracking may resume in it.
  std::shared_ptr<const Reference> last = newest_.reference;
  const int last_segment = newest_.segment;
  newest_ = view, kept_ = kept;
  if (!newest_.reference) newest_.reference = std::move(last), newest_.segment = last_segment;
}

void ServoFeed::set_scale(const ServoScale& scale) {
  if (!(scale.metres_per_unit > 0 && std::isfinite(scale.metres_per_unit)))
    throw InputError("scale of the servo feed",
                     std::to_string(scale.metres_per_unit) + " metres per unit is not a scale",
                     "give a number larger than 0");
  const std::lock_guard<std::mutex> lock(mutex_);
  Sim3 to_metres{scale.metres_per_unit / last_odom_scale_, SE3()};
  if (scale_.is_metric() && newest_.T_cam_map) {
    const Eigen::Vector3d position = T_odom_cam(newest_, *newest_.T_cam_map).translation();
    to_metres.rigid = SE3(Eigen::Quaterniond::Identity(), to_metres_ * position - to_metres * position);
  }
  to_metres_ = to_metres;
  scale_ = scale;
}

void ServoFeed::fail(const std::string& message) {
  const std::lock_guard<std::mutex> lock(mutex_);
  failure_ = message;
}

ServoPose ServoFeed::pose(Timestamp now) const {
  const std::lock_guard<std::mutex> lock(mutex_);
  ServoPose pose;
  pose.view = newest_;
  pose.state = newest_.state;
  pose.p_right = newest_.p_right;
  pose.frame_index = newest_.frame_index;
  pose.time = newest_.time;
  pose.scale = scale_;
  pose.map_version = map_version_;
  pose.map_changes = newest_.world_changes;
  pose.mMo = to_visp((to_metres_ * Sim3{1, newest_.T_world_odom} * to_metres_.inverse()).rigid);
  pose.age_s = newest_.frame_index < 0 ? 0 : seconds_between(newest_.time, now);
  pose.reason = failure_.empty() ? not_usable_because(newest_, pose.age_s, options_) : failure_;
  pose.usable = pose.reason.empty();
  pose.usable_in_kept = kept_.is_by_own_map ? pose.usable
                                            : kept_.by_image && failure_.empty() &&
                                                  too_old_because(pose.age_s, options_).empty();
  pose.is_kept_by_image = kept_.by_image.has_value();
  if (kept_.by_image) pose.cMk = to_visp(kept_.by_image->inverse());
  if (!newest_.T_cam_map) return pose;
  pose.predicted_s = step_s_ > 0 ? std::clamp(pose.age_s, 0.0, options_.max_prediction_s) : 0;
  const SE3 T_cam_map = SE3::exp(pose.predicted_s * velocity_) * *newest_.T_cam_map;
  pose.view.T_cam_map = T_cam_map;
  pose.cMw = to_visp(in_metres(T_cam_map, scale_.metres_per_unit));
  if (kept_.is_by_own_map)
    pose.cMk = to_visp((newest_.T_world_odom * T_odom_cam(newest_, T_cam_map)).inverse());
  pose.cMo = to_visp(to_metres_.apply(T_odom_cam(newest_, T_cam_map)).inverse());
  pose.cMw_at_image = to_visp(in_metres(*newest_.T_cam_map, scale_.metres_per_unit));
  // e = e_k + a (e_k - e_{k-1}) with a = predicted / step: the errors of both poses count.
  const double a = step_s_ > 0 ? pose.predicted_s / step_s_ : 0;
  pose.view.covariance = (1 + 2 * a + 2 * a * a) * newest_.covariance;
  pose.covariance = to_visp_metres(pose.view.covariance, scale_.metres_per_unit);
  return pose;
}

}  // namespace edgevo
