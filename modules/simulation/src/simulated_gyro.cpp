// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/simulation/simulated_gyro.h"

#include <algorithm>
#include <cmath>

#include "edgevo/core/angle.h"
#include "edgevo/core/error.h"
#include "edgevo/core/output_file.h"
#include "edgevo/core/random.h"
#include "edgevo/core/rotation_vector.h"

namespace edgevo {
namespace {

constexpr uint64_t kGyroPurpose = 0x6779726f, kAccelerationPurpose = 0x61636365;
constexpr double kGravity = 9.81;  // m/s^2
// Half of the time over which rates and accelerations of the path are taken, seconds: a fraction of a sample.
constexpr double kRateStep = 1e-3, kAccelerationStep = 1e-2;
// White noise of the accelerometer, m/s^2 over the root of a hertz, and the standard deviation of its bias,
// m/s^2: of the same chips, once their makers have calibrated them.
constexpr double kAccelerationNoise = 2e-3, kAccelerationBias = 0.1;

// What such sensors have by their datasheets and by those who measured them; standard deviations where errors
// differ from one to the next.
struct GyroKind {
  const char* name;
  double rate_hz;
  double noise;       // rad/s over the root of a hertz
  double bias;        // rad/s
  double bias_walk;   // rad/s over the root of a second
  double scale;       // share
  double offset_s;    // of the clock
  double dropped;     // share of the samples
  double misaligned;  // rad, of the mounting
  Eigen::Matrix3d R_cam_gyro;
};

Eigen::Matrix3d axes(const Eigen::Vector3d& x, const Eigen::Vector3d& y) {
  Eigen::Matrix3d R;
  R << x, y, x.cross(y);
  return R;
}

const std::vector<GyroKind>& kinds() {
  static const std::vector<GyroKind> kKinds{
      // Held upright: x right, y up, z towards the holder.
      {"phone", 200, rad(0.01), rad(1), rad(0.003), 0.01, 0.015, 0.002, rad(1), axes({1, 0, 0}, {0, -1, 0})},
      // x forward, y left, z up.
      {"drone", 400, rad(0.008), rad(0.5), rad(0.003), 0.005, -0.006, 0.001, rad(2),
       axes({0, 0, 1}, {-1, 0, 0})},
      // A cheap board, turned by a quarter on a robot.
      {"robot", 100, rad(0.03), rad(1.5), rad(0.005), 0.015, 0.03, 0.02, rad(4), axes({1, 0, 0}, {0, 0, 1})}};
  return kKinds;
}

const GyroKind& kind_of(const std::string& name) {
  for (const GyroKind& k : kinds())
    if (name == k.name) return k;
  throw InputError("--gyro " + name, "no such gyro", "give phone, drone or robot");
}

Eigen::Vector3d normal3(Random* random) {
  const double x = random->normal(), y = random->normal(), z = random->normal();
  return {x, y, z};
}

// Angular velocity of the camera in its own axes.
Eigen::Vector3d rate_at(const std::function<SE3(double)>& T_scene_cam_at, double t) {
  const SE3 before = T_scene_cam_at(t - kRateStep), after = T_scene_cam_at(t + kRateStep);
  return rotation_vector(before.rotation().conjugate() * after.rotation()) / (2 * kRateStep);
}

// What an accelerometer feels, in scene axes.
Eigen::Vector3d felt_at(const std::function<SE3(double)>& T_scene_cam_at, double t) {
  const Eigen::Vector3d before = T_scene_cam_at(t - kAccelerationStep).translation(),
                        here = T_scene_cam_at(t).translation(),
                        after = T_scene_cam_at(t + kAccelerationStep).translation();
  return (before - 2 * here + after) / (kAccelerationStep * kAccelerationStep) +
         kGravity * Eigen::Vector3d::UnitZ();
}

std::string vector_text(const Eigen::Vector3d& v, int decimals) {
  return "[" + fixed(v.x(), decimals) + ", " + fixed(v.y(), decimals) + ", " + fixed(v.z(), decimals) + "]";
}

}  // namespace

std::vector<std::string> gyro_kinds() {
  std::vector<std::string> names;
  for (const GyroKind& k : kinds()) names.push_back(k.name);
  return names;
}

SimulatedGyro simulate_gyro(const std::function<SE3(double)>& T_scene_cam_at, double begin_s, double end_s,
                            const std::string& kind, uint64_t seed) {
  const GyroKind& k = kind_of(kind);
  Random random = Random::derive(seed, kGyroPurpose);
  SimulatedGyro gyro;
  gyro.rate_hz = k.rate_hz, gyro.noise = k.noise, gyro.dropped = k.dropped;
  GyroModel& truth = gyro.truth;
  truth.R_cam_gyro =
      rotation_of(k.misaligned * normal3(&random)) * Eigen::Quaterniond(k.R_cam_gyro).normalized();
  truth.offset_s = k.offset_s;
  truth.errors.scale = k.scale * normal3(&random);
  Eigen::Vector3d bias = k.bias * normal3(&random);
  Random of_accelerometer = Random::derive(seed, kAccelerationPurpose);
  gyro.acceleration_bias = kAccelerationBias * normal3(&of_accelerometer);
  const double step = 1 / k.rate_hz, noise = k.noise * std::sqrt(k.rate_hz);
  const Eigen::Vector3d shown_per_true = (Eigen::Vector3d::Ones() + truth.errors.scale).cwiseInverse();
  for (double t = begin_s; t <= end_s; t += step) {
    bias += k.bias_walk * std::sqrt(step) * normal3(&random);
    if (t < 0.5 * (begin_s + end_s)) truth.errors.bias = bias;
    const Eigen::Vector3d rate_noise = noise * normal3(&random), felt_noise = normal3(&random);
    if (random.uniform() < k.dropped || t + k.offset_s < 0) continue;
    const Eigen::Quaterniond R_gyro_cam = truth.R_cam_gyro.conjugate();
    const Eigen::Vector3d rate = R_gyro_cam * rate_at(T_scene_cam_at, t);
    const Eigen::Vector3d felt =
        R_gyro_cam * (T_scene_cam_at(t).rotation().conjugate() * felt_at(T_scene_cam_at, t));
    gyro.samples.push_back(
        {Timestamp::from_seconds(t + k.offset_s), shown_per_true.cwiseProduct(rate) + bias + rate_noise,
         felt + gyro.acceleration_bias + kAccelerationNoise * std::sqrt(k.rate_hz) * felt_noise});
  }
  gyro.last_bias = bias;
  return gyro;
}

std::string imu_text(const std::vector<GyroSample>& samples) {
  constexpr int64_t kNanoseconds = 1'000'000'000 / Timestamp::kTicksPerSecond;
  const bool is_felt = std::any_of(samples.begin(), samples.end(),
                                   [](const GyroSample& s) { return !s.acceleration.isZero(); });
  std::string text = "# timestamp[ns] w.x w.y w.z [rad/s]";
  text += is_felt ? " a.x a.y a.z [m/s^2]\n" : "\n";
  for (const GyroSample& sample : samples) {
    text += std::to_string(sample.time.ticks * kNanoseconds);
    for (const double value : sample.rate) text += " " + fixed(value, 7);
    if (is_felt)
      for (const double value : sample.acceleration) text += " " + fixed(value, 5);
    text += "\n";
  }
  return text;
}

std::string gyro_truth_text(const SimulatedGyro& gyro, const std::string& kind) {
  const GyroModel& m = gyro.truth;
  const Eigen::Quaterniond& q = m.R_cam_gyro;
  return "# What `edgevo simulate --gyro " + kind + "` gave the gyro of imu.txt.\nkind: " + kind +
         "\n# turns vectors from the axes of the gyro to those of the camera\nR_cam_gyro_xyzw: [" +
         fixed(q.x(), 8) + ", " + fixed(q.y(), 8) + ", " + fixed(q.z(), 8) + ", " + fixed(q.w(), 8) +
         "]\n# its clock less that of the images, seconds\noffset_s: " + fixed(m.offset_s, 6) +
         "\n# in the middle of the time and at the last sample, rad/s\nbias: " +
         vector_text(m.errors.bias, 7) + "\nlast_bias: " + vector_text(gyro.last_bias, 7) +
         "\n# true rate over shown rate, less 1\nscale: " + vector_text(m.errors.scale, 6) +
         "\n# in the axes of the camera at the first image\nup: " + vector_text(gyro.up, 6) +
         "\n# m/s^2\nacceleration_bias: " + vector_text(gyro.acceleration_bias, 5) +
         "\nrate_hz: " + fixed(gyro.rate_hz, 1) +
         "\n# rad/s over the root of a hertz\nnoise: " + fixed(gyro.noise, 8) +
         "\n# share of the samples\ndropped: " + fixed(gyro.dropped, 4) + "\n";
}

}  // namespace edgevo
