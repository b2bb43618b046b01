// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Images and gyro of a phone in a hand that shakes.
#include <cmath>
#include <vector>

#include "edgevo/core/gyro_sample.h"
#include "edgevo/core/image_source.h"
#include "edgevo/core/rotation_vector.h"
#include "edgevo/simulation/simulated_gyro.h"
#include "support/hollow_scene.h"

namespace edgevo::test {

/// Seconds from image to image, and their number.
constexpr double kHandStep = 0.05;
constexpr int kHandFrames = 100;

/// A hand that moves through the room and shakes.
inline SE3 hand_at(double t) {
  const Eigen::Vector3d turn(0.12 * std::sin(5.3 * t), 0.16 * std::sin(4.1 * t), 0.10 * std::sin(4.7 * t));
  return sweep_pose(t / kHandStep) * SE3(rotation_of(turn), Eigen::Vector3d::Zero());
}

inline SE3 hand_at_frame(int k) { return hand_at(kHandStep * k); }

/// What its camera sees, next to a gyro; `readout_s`: of its shutter, 0: it does not roll.
class HandSource : public ImageSource {
 public:
  HandSource(double readout_s, const std::vector<GyroSample>& gyro) : readout_s_(readout_s), gyro_(gyro) {}

  const Camera& camera() const override { return scene_.camera; }
  std::optional<int> size() const override { return kHandFrames; }
  std::string kind() const override { return "a hand"; }
  GyroReadings gyro_readings() const override {
    if (gyro_.empty()) return {};
    return [this, next = size_t(0)]() mutable -> std::optional<GyroSample> {
      return next < gyro_.size() ? std::make_optional(gyro_[next++]) : std::nullopt;
    };
  }
  std::optional<Frame> next() override {
    if (next_ == kHandFrames) return std::nullopt;
    const int k = next_++;
    return Frame{
        k, Timestamp::from_seconds(kHandStep * k),
        scene_.render_rolling([&](double late) { return hand_at(kHandStep * k + late * readout_s_); }, 1.5,
                              uint64_t(k + 1))};
  }

 private:
  HollowScene scene_;
  double readout_s_;
  const std::vector<GyroSample>& gyro_;
  int next_ = 0;
};

/// The samples of a phone in that hand.
inline std::vector<GyroSample> phone_in_hand() {
  return simulate_gyro(hand_at, 0, kHandStep * kHandFrames + 0.5, "phone", 3).samples;
}

}  // namespace edgevo::test
