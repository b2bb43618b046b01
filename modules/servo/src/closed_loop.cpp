// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/servo/closed_loop.h"

#include <visp3/core/vpExponentialMap.h>

#include <algorithm>
#include <cmath>

#include "delayed_sensor.h"
#include "edgevo/core/angle.h"
#include "edgevo/core/order_statistics.h"
#include "edgevo/core/rectification.h"
#include "edgevo/visp_bridge/conversions.h"
#include "simulated_camera.h"

namespace edgevo {
namespace {
constexpr double kHold_s = 1;  // the median of the errors over this time says whether the loop has converged
// A camera that is not found in the kept map for so long is moved around by hand.
constexpr double kUntilHand_s = 1;

// A loop that steers to a goal of an earlier one has nothing to teach.
MotionPlan plan_of(const ServoParams& params) {
  MotionPlan plan = plan_over_desk(params.seed);
  if (!params.map.empty()) plan.teach_s = plan.away_s = 0;
  return plan;
}

class ClosedLoop {
 public:
  ClosedLoop(const ServoParams& params, const OdometryParams& odometry)
      : params_(params),
        goal_(params.map.empty() ? KeptGoal() : read_kept_goal(params.map)),
        plan_(plan_of(params)),
        camera_(params, plan_),
        sensor_(camera_.model(), odometry, params, &feed_, kept_places()),
        law_(make_control_law(params.law, camera_.model().pinhole(), params.gain, params.points)),
        T_scene_cam_(is_restarted() ? plan_.T_scene_start : plan_.T_scene_cam(0)) {
    if (is_restarted()) aim_at_kept_goal();
  }

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
    result_.kept = keep();
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
    if (phase == Phase::kServo)
      is_restarted() ? steer_in_kept_map(pose, index, &row) : steer(pose, index, &row);
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
    std::vector<Eigen::Vector2d> px;
    for (const ServoPoint& point : law_->points(metric))
      px.push_back(p.project({point.point.get_x(), point.point.get_y(), 1}));
    show_taught(px);
    taught_frame_ = pose.frame_index;
    kept_metres_per_unit_ = result_.metres_per_unit / pose.view.odom_scale;
  }

  // Notes the points that the taught view has at these pixels, for the evaluation.
  void show_taught(const std::vector<Eigen::Vector2d>& at) {
    const std::vector<float> depth = camera_.renderer().render_depth_from(plan_.T_scene_taught);
    for (const Eigen::Vector2d& px : at) {
      const double z = depth_near(depth, px);
      if (!(z > 0)) continue;
      result_.points_taught.push_back(px);
      points_scene_.push_back(plan_.T_scene_taught * (z * camera_.model().pinhole().ray(px)));
    }
    result_.taught = camera_.renderer().render_image_from(plan_.T_scene_taught, 0);
  }

  // ---- a goal that was kept ----

  bool is_restarted() const { return !params_.map.empty(); }
  std::shared_ptr<const PlaceStore> kept_places() const {
    return is_restarted() ? read_kept_places(params_.map, Rectification(camera_.model()).target()) : nullptr;
  }

  void aim_at_kept_goal() {
    result_.metres_per_unit = goal_.metres_per_unit;
    law_->aim(to_visp(in_metres(goal_.T_map_taught.inverse())), 0);
    const Pinhole p = camera_.model().pinhole();
    std::vector<Eigen::Vector2d> grid;
    constexpr int kColumns = 5, kRows = 4;
    for (int i = 0; i < kColumns * kRows; ++i)
      grid.emplace_back(p.width * (i % kColumns + 0.5) / kColumns, p.height * (i / kColumns + 0.5) / kRows);
    show_taught(grid);
    taught_ = true;
  }

  SE3 in_metres(const SE3& T) const { return {T.rotation(), goal_.metres_per_unit * T.translation()}; }

  // The pose in the kept map.
  ServoPose in_kept_map(ServoPose pose) const {
    if (pose.usable && !pose.usable_in_kept) pose.reason = "not found in the kept map";
    pose.usable = pose.usable_in_kept;
    if (!pose.usable) return pose;
    pose.cMw = to_visp(in_metres(to_se3(*pose.cMk)));
    pose.map_version = 0;
    return pose;
  }

  // By the law where it is known where the camera is; else by hand.
  void steer_in_kept_map(const ServoPose& live, int index, ServoRow* row) {
    const ServoPose pose = in_kept_map(live);
    steer(pose, index, row);
    if (pose.usable && !is_found_)
      is_found_ = true, camera_.begin_darkness(row->time_s + params_.blackout_at_s);
    unknown_s_ = pose.usable ? 0 : unknown_s_ + 1 / params_.rate_hz;
    if (const auto share = camera_.darkness(row->time_s)) return carry(*share);
    if (unknown_s_ < kUntilHand_s) {
      by_hand_s_ = 0;
      return;
    }
    if (by_hand_s_ == 0) T_scene_hand_ = T_scene_cam_;
    by_hand_s_ += 1 / params_.rate_hz;
    T_scene_cam_ = T_scene_hand_ * moved_by_hand(by_hand_s_);
  }

  void carry(double share) {
    by_hand_s_ = unknown_s_ = 0;
    if (!params_.is_carried) return;
    if (!T_scene_dark_) T_scene_dark_ = T_scene_cam_;
    T_scene_cam_ = on_the_way(*T_scene_dark_, plan_.T_scene_start, share);
  }

  // What later loops need; a loop that was not taught leaves nothing.
  std::optional<KeptLoop> keep() {
    if (taught_frame_ < 0) return std::nullopt;
    KeptLoop kept = sensor_.finish();
    const auto taught = std::find_if(kept.run.frames.begin(), kept.run.frames.end(),
                                     [&](const FrameRecord& f) { return f.index == taught_frame_; });
    if (taught == kept.run.frames.end() || !taught->T_world_cam) return std::nullopt;
    kept.goal = {*taught->T_world_cam, kept_metres_per_unit_};
    return kept;
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
    result_.converged = stays_at_goal(row->command.at_goal && !stopped);
    // T_c(t)_c(t+dt) = exp(v dt), with the velocity of the camera in its own axes.
    T_scene_cam_ =
        T_scene_cam_ * to_se3(vpExponentialMap::direct(row->command.velocity, 1 / params_.rate_hz));
  }

  // Whether the median error over kHold_s is within the goal: the pose of one image alone is noisy in bad
  // light.
  bool stays_at_goal(bool is_at_goal) {
    was_at_goal_.push_back(is_at_goal);
    const auto images = std::lround(kHold_s * params_.rate_hz);
    if (long(was_at_goal_.size()) < images) return false;
    return 2 * std::count(was_at_goal_.end() - images, was_at_goal_.end(), true) > images;
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
  KeptGoal goal_;  // of an earlier loop
  MotionPlan plan_;
  SimulatedCamera camera_;
  ServoFeed feed_;
  DelayedSensor sensor_;
  std::unique_ptr<ControlLaw> law_;
  SE3 T_scene_cam_;
  bool taught_ = false, started_ = false, was_stopped_ = false;
  std::vector<bool> was_at_goal_;  // of each image while it is steered
  std::vector<Eigen::Vector3d> points_scene_;
  int taught_frame_ = -1;
  double kept_metres_per_unit_ = 1;
  bool is_found_ = false;
  double unknown_s_ = 0, by_hand_s_ = 0;
  SE3 T_scene_hand_;                 // where the hand has begun
  std::optional<SE3> T_scene_dark_;  // where the darkness has begun
  ServoResult result_;
};

}  // namespace

ServoResult run_closed_loop(const ServoParams& params, const OdometryParams& odometry,
                            const std::function<bool(double)>& on_step) {
  return ClosedLoop(params, odometry).run(on_step);
}

}  // namespace edgevo
