// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/servo/closed_loop.h"

#include <visp3/core/vpExponentialMap.h>

#include <cmath>

#include "delayed_sensor.h"
#include "edgevo/core/angle.h"
#include "edgevo/core/order_statistics.h"
#include "edgevo/visp_bridge/conversions.h"
#include "simulated_camera.h"

namespace edgevo {
namespace {
constexpr double kHold_s = 1;  // time at the goal until the loop counts as converged

class ClosedLoop {
 public:
  ClosedLoop(const ServoParams& params, const OdometryParams& odometry)
      : params_(params),
        plan_(plan_over_desk(params.seed)),
        camera_(params, plan_),
        sensor_(camera_.model(), odometry, params, &feed_),
        law_(make_control_law(params.law, camera_.model().pinhole(), params.gain, params.points)),
        T_scene_cam_(plan_.T_scene_cam(0)) {}

  ServoResult run(const std::function<bool(double)>& on_step) {
    const double servo_begin_s = plan_.teach_s + plan_.away_s;
    for (int i = 0; result_.failure.empty() && !result_.converged; ++i) {
      const double now = i / params_.rate_hz;
      if (now > servo_begin_s + params_.limit_s || !step(i, now) || !on_step(now)) break;
    }
    if (result_.failure.empty() && result_.points_taught.empty())
      result_.failure = "ended before the servo loop began";
    if (result_.failure.empty()) measure_end();
    result_.replaced = sensor_.replaced();
    result_.camera = camera_.model();
    return std::move(result_);
  }

 private:
  // Processes one image and, in the servo phase, one command that holds until the next.
  bool step(int index, double now) {
    const Phase phase = plan_.phase(now);
    if (phase != Phase::kServo) T_scene_cam_ = plan_.T_scene_cam(now);
    sensor_.advance(now, &result_.rows);
    ServoRow row;
    row.time_s = now;
    row.phase = phase;
    row.T_scene_cam = T_scene_cam_;
    note_truth(&row);
    const ServoPose pose = feed_.pose(Timestamp::from_seconds(now));
    row.state = pose.state;
    row.age_s = pose.age_s;
    if (phase != Phase::kTeach && !taught_) teach(pose);
    if (!result_.failure.empty()) return false;
    if (phase == Phase::kServo) steer(pose, index, &row);
    result_.rows.push_back(row);
    if (std::optional<GrayImage> image = camera_.take(row.T_scene_cam, index, now))
      sensor_.push({index, Timestamp::from_seconds(now), std::move(*image)});
    return true;
  }

  // Teaches the goal at the end of the first phase, with the camera at rest at the taught pose.
  void teach(const ServoPose& pose) {
    taught_ = true;
    if (!set_scale(pose)) return;
    std::string why;
    const ServoPose metric = feed_.pose(pose.time);
    if (!law_->teach(metric, &why)) {
      result_.failure = "the pose could not be taught: " + why;
      return;
    }
    const Pinhole p = camera_.model().pinhole();
    const std::vector<float> depth = camera_.renderer().render_depth_from(plan_.T_scene_taught);
    for (const ServoPoint& point : law_->points(metric)) {
      const Eigen::Vector2d px = p.project({point.point.get_x(), point.point.get_y(), 1});
      const double z = depth_near(depth, px);
      if (!(z > 0)) continue;
      result_.points_taught.push_back(px);
      points_scene_.push_back(plan_.T_scene_taught * (z * p.ray(px)));
    }
    result_.taught = camera_.renderer().render_image_from(plan_.T_scene_taught, 0);
  }

  // Sets the scale to the true metres per unit of the map, which is best known at the taught pose.
  bool set_scale(const ServoPose& pose) {
    if (!pose.usable) {
      result_.failure = "the pose could not be taught: " + pose.reason;
      return false;
    }
    const std::vector<float> depth = camera_.renderer().render_depth_from(plan_.T_scene_taught);
    const SE3 T_cam_ref = *pose.view.T_cam_map * pose.view.reference->T_ref_world.inverse();
    std::vector<double> ratios;
    for (const CloudPoint& c : pose.view.reference->cloud.points) {
      const Eigen::Vector3d p = T_cam_ref * (c.ray / c.idepth);
      if (c.host_keyframe < 0 || !(p.z() > 0)) continue;
      const double z = depth_near(depth, camera_.model().pinhole().project(p));
      if (z > 0) ratios.push_back(z / p.z());
    }
    if (ratios.empty()) {
      result_.failure = "the pose could not be taught: the map has no points of known depth";
      return false;
    }
    result_.metres_per_unit = params_.scale_error * median(std::move(ratios));
    feed_.set_scale({result_.metres_per_unit, 0,
                     "ground truth at the taught pose, times " + std::to_string(params_.scale_error)});
    return true;
  }

  // Depth of the nearest surface within a pixel, to which an edge belongs; 0: none, or outside the image.
  double depth_near(const std::vector<float>& depth, const Eigen::Vector2d& px) const {
    const Pinhole p = camera_.model().pinhole();
    if (!p.contains(px, 1)) return 0;
    const int u = int(std::lround(px.x())), v = int(std::lround(px.y()));
    double nearest = 0;
    for (int dv = -1; dv <= 1; ++dv)
      for (int du = -1; du <= 1; ++du) {
        const double z = double(depth[size_t(v + dv) * p.width + u + du]);
        if (z > 0 && (nearest == 0 || z < nearest)) nearest = z;
      }
    return nearest;
  }

  void steer(const ServoPose& pose, int index, ServoRow* row) {
    if (!started_) begin_steering(index, *row);
    row->command = law_->command(pose);
    const bool stopped = !row->command.stop.empty();
    if (stopped && !was_stopped_) ++result_.stops;
    was_stopped_ = stopped;
    result_.stopped_s += stopped ? 1 / params_.rate_hz : 0;
    at_goal_s_ = row->command.at_goal && !stopped ? at_goal_s_ + 1 / params_.rate_hz : 0;
    result_.converged = at_goal_s_ >= kHold_s;
    // T_c(t)_c(t+dt) = exp(v dt), with the velocity of the camera in its own axes.
    T_scene_cam_ =
        T_scene_cam_ * to_se3(vpExponentialMap::direct(row->command.velocity, 1 / params_.rate_hz));
  }

  void begin_steering(int index, const ServoRow& row) {
    started_ = true;
    result_.start = camera_.renderer().render_image_from(row.T_scene_cam, index);
    result_.start_mm = row.true_mm;
    result_.start_deg = row.true_deg;
    result_.points_start = pixels_from(row.T_scene_cam);
    result_.start_px = rms_px(result_.points_start);
  }

  void measure_end() {
    ServoRow end;
    end.T_scene_cam = T_scene_cam_;
    note_truth(&end);
    result_.final_mm = end.true_mm;
    result_.final_deg = end.true_deg;
    result_.points_final = pixels_from(T_scene_cam_);
    result_.final_px = rms_px(result_.points_final);
    result_.final = camera_.renderer().render_image_from(T_scene_cam_, int(result_.rows.size()));
  }

  void note_truth(ServoRow* row) const {
    const SE3 T_taught_cam = plan_.T_scene_taught.inverse() * row->T_scene_cam;
    row->true_mm = 1000 * T_taught_cam.translation().norm();
    row->true_deg = deg(T_taught_cam.angle());
  }

  // True pixels of the feed's points in the image at a pose.
  std::vector<Eigen::Vector2d> pixels_from(const SE3& T_scene_cam) const {
    std::vector<Eigen::Vector2d> px;
    for (const Eigen::Vector3d& p : points_scene_)
      px.push_back(camera_.model().pinhole().project(T_scene_cam.inverse() * p));
    return px;
  }

  double rms_px(const std::vector<Eigen::Vector2d>& px) const {
    double square = 0;
    for (size_t i = 0; i < px.size(); ++i) square += (px[i] - result_.points_taught[i]).squaredNorm();
    return px.empty() ? 0 : std::sqrt(square / double(px.size()));
  }

  ServoParams params_;
  MotionPlan plan_;
  SimulatedCamera camera_;
  ServoFeed feed_;
  DelayedSensor sensor_;
  std::unique_ptr<ControlLaw> law_;
  SE3 T_scene_cam_;
  bool taught_ = false, started_ = false, was_stopped_ = false;
  double at_goal_s_ = 0;
  std::vector<Eigen::Vector3d> points_scene_;
  ServoResult result_;
};

}  // namespace

ServoResult run_closed_loop(const ServoParams& params, const OdometryParams& odometry,
                            const std::function<bool(double)>& on_step) {
  return ClosedLoop(params, odometry).run(on_step);
}

}  // namespace edgevo
