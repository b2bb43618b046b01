// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A hand that holds a camera and a gyro, and what a run would show a GyroAid.
#include <functional>
#include <string>

#include "edgevo/core/angle.h"
#include "edgevo/core/random.h"
#include "edgevo/core/rotation_vector.h"
#include "edgevo/gyro/gyro_aid.h"
#include "edgevo/simulation/simulated_gyro.h"

namespace edgevo::test {

constexpr double kFrame = 1.0 / 30, kImageNoise = rad(0.015);

// A hand that turns about three axes, or one.
inline SE3 hand_at(double t, bool one_axis) {
  const Eigen::Vector3d all(0.2 * std::sin(2.1 * t), 0.4 * std::sin(1.3 * t) + 0.1 * std::sin(5 * t),
                            0.15 * std::sin(1.7 * t + 1));
  const Eigen::Vector3d turn = one_axis ? Eigen::Vector3d(0, all.y(), 0) : all;
  return {rotation_of(turn), Eigen::Vector3d::Zero()};
}

struct Placed {
  bool one_axis = false;
  double seconds = 20;
  std::string kind = "phone";
  uint64_t seed = 1;
  std::function<void(size_t i, GyroSample*)> change = [](size_t, GyroSample*) {};
};

inline SimulatedGyro gyro_of(const Placed& b) {
  return simulate_gyro([&](double t) { return hand_at(t, b.one_axis); }, 0, b.seconds + 0.5, b.kind, b.seed);
}

// Feeds samples and turns of images, as a run does; `on_image` after each.
inline GyroAid follow(const Placed& b, const SimulatedGyro& gyro,
                      const std::function<void(double, const GyroAid&)>& on_image = {}) {
  GyroAid aid;
  Random random(b.seed);
  size_t next = 0;
  for (double t = 0; t + kFrame < b.seconds; t += kFrame) {
    for (; next < gyro.samples.size() && gyro.samples[next].time.seconds() < t + kFrame + 0.3; ++next) {
      GyroSample sample = gyro.samples[next];
      b.change(next, &sample);
      aid.add(sample);
    }
    const Eigen::Vector3d noise(random.normal(), random.normal(), random.normal());
    const Eigen::Quaterniond R = rotation_of(kImageNoise * noise) *
                                 hand_at(t + kFrame, b.one_axis).rotation().conjugate() *
                                 hand_at(t, b.one_axis).rotation();
    const Eigen::Matrix3d covariance = kImageNoise * kImageNoise * Eigen::Matrix3d::Identity();
    aid.see(Timestamp::from_seconds(t), Timestamp::from_seconds(t + kFrame), R, covariance);
    if (on_image) on_image(t + kFrame, aid);
  }
  return aid;
}

}  // namespace edgevo::test
