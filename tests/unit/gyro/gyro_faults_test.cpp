// SPDX-License-Identifier: BSD-3-Clause
// A gyro that fails in the middle of a run: its covariance covers its errors from the next images on, it is
// named, and what can be followed is followed.
#include <gmock/gmock.h>

#include <cmath>
#include <cstdio>

#include "unit/gyro/gyro_hand.h"

namespace edgevo::test {
namespace {

using ::testing::HasSubstr;

constexpr double kFaultS = 12;

struct Fault {
  const char* name;
  const char* named;  // in the statement
  std::function<void(double s, Random*, GyroSample*)> change;  // `s`: seconds since it began
};

const std::vector<Fault>& faults() {
  static const Eigen::Vector3d kAxis(0.6, -0.64, 0.48);
  static const std::vector<Fault> kFaults{
      {"none", "observed", [](double, Random*, GyroSample*) {}},
      {"bias 0.5", "bias has changed", [](double, Random*, GyroSample* s) { s->rate += rad(0.5) * kAxis; }},
      {"bias 2", "bias has changed", [](double, Random*, GyroSample* s) { s->rate += rad(2) * kAxis; }},
      {"bias 5", "bias has changed", [](double, Random*, GyroSample* s) { s->rate += rad(5) * kAxis; }},
      {"ramp", "bias", [](double t, Random*, GyroSample* s) { s->rate += t * rad(0.3) * kAxis; }},
      {"scale 5", "scales", [](double, Random*, GyroSample* s) { s->rate *= 1.05; }},
      {"scale 20", "scales", [](double, Random*, GyroSample* s) { s->rate *= 1.2; }},
      {"clock", "gains",
       [](double t, Random*, GyroSample* s) { s->time.ticks += int64_t(1e-3 * t * Timestamp::kTicksPerSecond); }},
      {"late", "jumped", [](double, Random*, GyroSample* s) { s->time.ticks += Timestamp::kTicksPerSecond / 20; }},
      {"zeros", "spikes",
       [](double, Random* random, GyroSample* s) {
         if (random->uniform() < 0.02) s->rate.setZero();
       }},
      {"huge", "spikes",
       [](double, Random* random, GyroSample* s) {
         if (random->uniform() < 0.02) s->rate = Eigen::Vector3d(20, -8, 9);
       }},
      {"noise 20", "more than",
       [](double, Random* random, GyroSample* s) {
         const double x = random->normal(), y = random->normal(), z = random->normal();
         s->rate += 20 * rad(0.01) * std::sqrt(200.0) * Eigen::Vector3d(x, y, z);
       }},
      {"mirror", "mirrored", [](double, Random*, GyroSample* s) { s->rate.y() *= -1; }},
      {"stuck", "stuck", [](double, Random*, GyroSample* s) { s->rate.setConstant(0.3); }},
  };
  return kFaults;
}

TEST(GyroFaults, Print) {
  for (const Fault& fault : faults()) {
    Placed b;
    b.seconds = 2 * kFaultS;
    const SimulatedGyro gyro = gyro_of(b);
    Random random(5);
    b.change = [&](size_t i, GyroSample* s) {
      const double since = gyro.samples[i].time.seconds() - kFaultS;
      if (since > 0) fault.change(since, &random, s);
    };
    double worst = 0, worst_deg = 0, last_bad = 0, first = 0, beyond_late = 0, sigma_late = 0; int n = 0, used = 0, frames = 0;
    double pull=0;
    GyroAid aid = follow(b, gyro, [&](double t, const GyroAid& now) {
      if (t < kFaultS) return;
      ++frames;
      // What the next image is aligned with.
      const auto turn = now.turn(Timestamp::from_seconds(t - 0.3), Timestamp::from_seconds(t));
      if (!turn) return;
      ++used;
      const Eigen::Quaterniond truth = hand_at(t, false).rotation().conjugate() * hand_at(t - 0.3, false).rotation();
      const Eigen::Vector3d e = rotation_vector(turn->R * truth.conjugate());
      const double sigmas = std::sqrt(e.dot(turn->covariance.inverse() * e));
      // pull on edges of 0.02 degrees
      worst = std::max(worst, sigmas), worst_deg = std::max(worst_deg, deg(e.norm()));
      const Eigen::Matrix3d I = Eigen::Matrix3d::Identity()*std::pow(rad(0.05),2);
      pull = std::max(pull, deg((I*(I+turn->covariance).inverse()*e).norm()));
      if (sigmas > 4) last_bad = t, ++n;
      if (t > 2 * kFaultS - 4) beyond_late += sigmas*sigmas/3, sigma_late += deg(std::sqrt(turn->covariance.trace())), first += 1;
    });
    std::printf("%-9s worst %.1f sig, %.2f deg, pull %.3f; beyond 4 sigma %d frames, last %.2f s after; used %d/%d; late NIS %.2f sigma %.3f deg\n   %s\n", fault.name,
                worst, worst_deg, pull, n, last_bad - kFaultS, used, frames, beyond_late/first, sigma_late/first, aid.statement().c_str());
    for (const std::string& line : aid.take_reports()) std::printf("      %s\n", line.c_str());
  }
}

}  // namespace
}  // namespace edgevo::test
