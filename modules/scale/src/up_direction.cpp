// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/scale/up_direction.h"

#include <cmath>

#include "edgevo/core/angle.h"
#include "edgevo/core/camera_mount.h"
#include "edgevo/core/output_file.h"
#include "up_cues.h"

namespace edgevo {
namespace {
// Cues further apart than this contradict one another: standard deviations, and radians.
constexpr double kAgreeSigmas = 3, kAgree = rad(1.5);
constexpr double kUpright = rad(60);  // the largest roll that is guessed without the ground
// Degrees. A camera that is tilted by less than kLevelTilt is taken to look straight ahead: cars squat, roads
// climb, and the level cameras of KITTI come out within 2 degrees. Up to kLevelled the map stays as it is,
// with a doubt, since cameras of cars are mounted like that and their maps were never levelled.
constexpr double kLevelTilt = 3, kLevelled = 7;
constexpr double kMinSigmas = 4;
constexpr double kMaxSigma = 1.5;  // degrees

struct Combined {
  double angle = 0, sigma = 0;
  int agree = 0, contradict = 0;
  bool is_more_than_turns = false;
  std::string names;
};

// The multiple of the cue's period that is nearest to `angle`.
double near(double angle, const UpCue& w) { return angle + std::remainder(w.angle - angle, w.period); }

// Angle to start from: the ground's, else the cue nearest to the upright camera.
std::optional<double> first_angle(const std::vector<UpCue>& cues) {
  std::optional<double> first;
  for (const UpCue& w : cues) {
    if (w.period > kPi * 1.5) return w.angle;
    const double angle = near(0, w);
    if (std::abs(angle) < kUpright && (!first || std::abs(angle) < std::abs(*first))) first = angle;
  }
  return first;
}

std::optional<Combined> combine(const std::vector<UpCue>& cues) {
  const std::optional<double> start = first_angle(cues);
  if (!start) return std::nullopt;
  Combined c;
  double weights = 0, sum = 0;
  for (const UpCue& w : cues) {
    const double off = near(*start, w) - *start;
    if (std::abs(off) > kAgreeSigmas * w.sigma + kAgree) {
      ++c.contradict;
      continue;
    }
    const double weight = 1 / (w.sigma * w.sigma);
    weights += weight, sum += weight * off, ++c.agree;
    c.is_more_than_turns |= w.period != kPi;
    c.names += std::string(", ") + w.name;
  }
  c.angle = *start + sum / weights;
  c.sigma = std::sqrt(1 / weights);
  return c;
}

std::string seen(const UpEstimate& up) { return up.seen_in + ", +- " + fixed(up.sigma_deg, 1) + " degrees"; }

}  // namespace

std::optional<UpEstimate> estimate_up(const Run& run) {
  const Drive drive = drive_of(run);
  const auto axes = travel_axes(drive);
  if (!axes) return std::nullopt;
  std::vector<UpCue> cues;
  for (const auto& find : {ground_cue, line_cue, turn_cue})
    if (const auto cue = find(drive, *axes)) cues.push_back(*cue);
  const auto roll = combine(cues);
  if (!roll) return std::nullopt;
  UpEstimate up;
  up.up = -axes->across(roll->angle);
  up.sigma_deg = deg(std::hypot(axes->sigma, roll->sigma));
  up.tilt_deg = deg(std::acos(std::clamp(-up.up.y(), -1.0, 1.0)));
  up.seen_in = "direction of travel" + roll->names;
  // Mounts have right angles: the ground or the lines alone are believed where they agree with one.
  const bool is_right_angle = roll->is_more_than_turns && std::abs(std::remainder(roll->angle, kPi / 2)) <
                                                              kAgreeSigmas * roll->sigma + kAgree;
  up.is_certain = roll->contradict == 0 && (roll->agree >= 2 || is_right_angle) && up.sigma_deg < kMaxSigma;
  return up;
}

SE3 level_mount(const Eigen::Vector3d& up) {
  const Eigen::Vector3d z = Eigen::Vector3d::UnitZ(), y = Eigen::Vector3d::UnitY();
  // A camera that looks straight down or up: forward is the upper edge of its image, or the lower one.
  const Eigen::Vector3d ahead = std::abs(up.dot(z)) < 0.99 ? z : Eigen::Vector3d(up.dot(z) < 0 ? -y : y);
  Eigen::Matrix3d R;  // rows: the axes of the vehicle in the camera's
  R.row(2) = up.transpose();
  R.row(0) = (ahead - ahead.dot(up) * up).normalized().transpose();
  R.row(1) = R.row(2).cross(R.row(0));
  return {R, Eigen::Vector3d::Zero()};
}

namespace {

// A vehicle that moves along another axis than its forward one.
std::optional<InputDecision> doubt_yaw(const Run& run) {
  constexpr double kMaxDeg = 30;  // a camera that is turned on its robot by less may be meant
  const auto axes = travel_axes(drive_of(run));
  if (!axes) return std::nullopt;
  const Eigen::Vector3d travel = run.T_vehicle_cam->R() * axes->forward;
  const double off_deg = deg(std::abs(std::atan2(travel.y(), travel.x())));
  if (off_deg < kMaxDeg) return std::nullopt;
  return InputDecision{"mount seen",
                       "the vehicle moves " + fixed(off_deg, 0) + " degrees from its forward axis",
                       "direction of travel",
                       "the yaw of the mount that was given may be wrong by that (roll, pitch, yaw), unless "
                       "the vehicle drove backwards or sideways."};
}

// A given mount against what was seen; nothing where they agree or nothing certain was seen.
std::optional<InputDecision> doubt_mount(const Run& run) {
  if (const auto yaw = doubt_yaw(run)) return yaw;
  const auto up = estimate_up(run);
  if (!up || !up->is_certain) return std::nullopt;
  const Eigen::Vector3d given = run.T_vehicle_cam->R().transpose() * Eigen::Vector3d::UnitZ();
  const double off_deg = deg(std::atan2(given.cross(up->up).norm(), given.dot(up->up)));
  if (off_deg < std::max(kLevelled, kMinSigmas * up->sigma_deg)) return std::nullopt;
  return InputDecision{"mount seen", describe(camera_mount(level_mount(up->up))), seen(*up),
                       "the mount that was given differs from it by " + fixed(off_deg, 0) +
                           " degrees: check its order (roll, pitch, yaw), signs and unit (degrees)."};
}

}  // namespace

std::optional<InputDecision> decide_up(Run* run, const std::optional<UpEstimate>& by_gravity) {
  if (run->T_vehicle_cam) return doubt_mount(*run);
  InputDecision decision{"mount", "looks straight ahead", "assumed", ""};
  const auto up = estimate_up(*run);
  if (by_gravity && by_gravity->is_certain && !(up && up->is_certain)) {
    run->T_vehicle_cam = level_mount(by_gravity->up);
    return InputDecision{"mount", describe(camera_mount(*run->T_vehicle_cam)), seen(*by_gravity), ""};
  }
  if (!up) return decision;
  if (up->tilt_deg < std::max(up->is_certain ? kLevelTilt : kLevelled, kMinSigmas * up->sigma_deg)) {
    decision.reason =
        "assumed; by " + seen(*up) + ", up lies " + fixed(up->tilt_deg, 1) + " degrees from there";
    return decision;
  }
  if (!up->is_certain) {
    decision.doubt = "by " + seen(*up) + ", up may lie " + fixed(up->tilt_deg, 0) +
                     " degrees from there, which is not certain; if the maps lie on a slope, measure how the "
                     "camera is mounted, and give --mount roll,pitch,yaw";
    return decision;
  }
  const SE3 mount = level_mount(up->up);
  const CameraMount angles = camera_mount(mount);
  if (up->tilt_deg > kLevelled) {
    run->T_vehicle_cam = mount;
    return InputDecision{"mount", describe(angles), "seen: " + seen(*up), ""};
  }
  decision.doubt = "by " + seen(*up) + ", it " + describe(angles) +
                   "; the maps lie on that slope; for level maps give --mount " + fixed(angles.roll_deg, 1) +
                   "," + fixed(angles.pitch_deg, 1) + ",0";
  return decision;
}

}  // namespace edgevo
