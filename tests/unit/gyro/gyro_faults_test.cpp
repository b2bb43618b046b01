// SPDX-License-Identifier: BSD-3-Clause
// A gyro that fails in the middle of a run: its covariance covers its errors from the next images on, it is
// named, and what can be followed is followed.
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>

#include "unit/gyro/gyro_hand.h"

namespace edgevo::test {
namespace {

using ::testing::HasSubstr;

constexpr double kFaultS = 12;

struct Fault {
  const char* name;
  const char* named;                                           // in the statement
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
       [](double t, Random*, GyroSample* s) {
         s->time.ticks += int64_t(1e-3 * t * Timestamp::kTicksPerSecond);
       }},
      {"late", "jumped",
       [](double, Random*, GyroSample* s) { s->time.ticks += Timestamp::kTicksPerSecond / 20; }},
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
      {"missing", "% of its samples are missing",
       [](double, Random* random, GyroSample* s) {
         if (random->uniform() < 0.2) s->rate.setConstant(std::nan(""));
       }},
      {"mirror", "mirrored", [](double, Random*, GyroSample* s) { s->rate.y() *= -1; }},
      {"stuck", "stuck", [](double, Random*, GyroSample* s) { s->rate.setConstant(0.3); }},
  };
  return kFaults;
}

struct Outcome {
  double worst_sigmas = 0;  // of the rotation over three tenths of a second, in its covariance
  double late_degrees = 0;  // its worst error in the last four seconds
  std::string statement;
};

Outcome run_with(const Fault& fault) {
  constexpr double kTurnS = 0.3;
  Placed b;
  b.seconds = 2 * kFaultS;
  const SimulatedGyro gyro = gyro_of(b);
  Random random(5);
  b.change = [&](size_t i, GyroSample* s) {
    const double since = gyro.samples[i].time.seconds() - kFaultS;
    if (since > 0) fault.change(since, &random, s);
  };
  Outcome outcome;
  const GyroAid aid = follow(b, gyro, [&](double t, const GyroAid& now) {
    const auto turn = now.turn(Timestamp::from_seconds(t - kTurnS), Timestamp::from_seconds(t));
    if (t < kFaultS || !turn) return;
    const Eigen::Quaterniond truth =
        hand_at(t, false).rotation().conjugate() * hand_at(t - kTurnS, false).rotation();
    const Eigen::Vector3d error = rotation_vector(turn->R * truth.conjugate());
    outcome.worst_sigmas =
        std::max(outcome.worst_sigmas, std::sqrt(error.dot(turn->covariance.inverse() * error)));
    const bool is_sure = deg(std::sqrt(turn->covariance.trace())) < 1;
    if (t > 2 * kFaultS - 4 && is_sure)
      outcome.late_degrees = std::max(outcome.late_degrees, deg(error.norm()));
  });
  outcome.statement = aid.statement();
  return outcome;
}

// Of a gyro without a fault the worst of these are 3 sigmas, and some 30 until two images have contradicted
// it; without rivals those of a bias of 5 degrees/s are more than 100, to the end.
TEST(GyroFaults, AreNamedAndWithinTheirCovarianceSoon) {
  for (const Fault& fault : faults()) {
    const Outcome outcome = run_with(fault);
    EXPECT_THAT(outcome.statement, HasSubstr(fault.named)) << fault.name;
    EXPECT_LT(outcome.worst_sigmas, 40) << fault.name;
    EXPECT_LT(outcome.late_degrees, 0.6) << fault.name;
  }
}

// Its rates stay away for half a second, and its driver fills them in.
TEST(GyroFaults, OneThatDoesNotTurnWithTheCameraIsNotUsedForAsLong) {
  constexpr double kWrongS = 0.5, kRightS = kFaultS + kWrongS;
  Placed b;
  b.seconds = 2 * kFaultS;
  const SimulatedGyro gyro = gyro_of(b);
  b.change = [&](size_t i, GyroSample* s) {
    const double t = gyro.samples[i].time.seconds();
    if (t > kFaultS && t < kRightS) s->rate = Eigen::Vector3d(1e-4 * double(i % 7), 0, 0);
  };
  int without = 0, back = 0;
  GyroAid aid = follow(b, gyro, [&](double t, const GyroAid& now) {
    const bool is_used =
        now.turn(Timestamp::from_seconds(t - kFrame), Timestamp::from_seconds(t)).has_value();
    if (t > kFaultS && t < kRightS) without += !is_used;
    if (t > kRightS + 1 && t < kRightS + 2) back += is_used;  // thirty images have confirmed it
  });
  EXPECT_GE(without, 0.8 * kWrongS / kFrame);
  EXPECT_GT(back, 0.8 / kFrame);
  EXPECT_THAT(aid.take_reports(), ::testing::Contains(HasSubstr("set aside")));
}

// An image that turns wrongly must not be taken for a gyro that has changed; the next ones show that it is
// none.
TEST(GyroFaults, ASingleWrongImageIsNoChange) {
  constexpr int kRight = 4;
  Placed b;
  const SimulatedGyro gyro = gyro_of(b);
  GyroAid aid = follow(b, gyro);
  const Eigen::Vector3d before = aid.model()->errors.bias;
  const Eigen::Matrix3d covariance = kImageNoise * kImageNoise * Eigen::Matrix3d::Identity();
  for (int i = 0; i <= kRight; ++i) {
    const double t = b.seconds - kFrame + i * kFrame;
    const Eigen::Quaterniond right =
        hand_at(t + kFrame, false).rotation().conjugate() * hand_at(t, false).rotation();
    aid.see(Timestamp::from_seconds(t), Timestamp::from_seconds(t + kFrame),
            i == 0 ? rotation_of({0.05, 0, 0}) : right, covariance);
  }
  EXPECT_LT(deg((aid.model()->errors.bias - before).norm()), 0.1);
  EXPECT_THAT(aid.statement(), ::testing::Not(HasSubstr("changed")));
}

// Turns to and fro at up to 1 rad/s, which `shown` changes as a sensor does.
const ClippedRates* clipped_rates_of(GyroIntegrator* gyro, double (*shown)(double)) {
  for (int i = 0; i < 2000; ++i) {
    const double t = 0.005 * i, rate = shown(std::sin(3 * t));
    gyro->add({Timestamp::from_seconds(t), {rate, 0.3 * std::cos(2 * t), 0.2 * std::sin(t)}});
  }
  return gyro->clipped();
}

TEST(GyroIntegrator, RatesThatEndAtTheLimitOfTheRangeAreClipped) {
  GyroIntegrator clipped, whole, coarse, rough;
  const ClippedRates* axis = clipped_rates_of(&clipped, [](double r) { return std::clamp(r, -0.8, 0.8); });
  ASSERT_TRUE(axis);
  EXPECT_DOUBLE_EQ(axis->limit(), 0.8);
  EXPECT_NEAR(axis->share(), 0.41, 0.03);
  EXPECT_FALSE(clipped_rates_of(&whole, [](double r) { return r; }));
  EXPECT_FALSE(clipped_rates_of(&coarse, [](double r) { return std::round(r / 0.02) * 0.02; }));
  EXPECT_FALSE(clipped_rates_of(&rough, [](double r) { return std::round(r / 0.3) * 0.3; }));
}

TEST(GyroIntegrator, ASpikeIsRemovedAndAHardTurnIsNot) {
  GyroIntegrator gyro;
  Random random(1);
  const auto feed = [&](int from, int to, const std::function<Eigen::Vector3d(int)>& rate) {
    for (int i = from; i < to; ++i)
      gyro.add({Timestamp::from_seconds(0.005 * i),
                rate(i) + 0.002 * Eigen::Vector3d(random.normal(), random.normal(), random.normal())});
  };
  feed(0, 400, [](int i) { return Eigen::Vector3d(std::sin(0.02 * i), 0, 0); });
  EXPECT_EQ(gyro.spikes(), 0);
  feed(400, 401, [](int) { return Eigen::Vector3d(9, -9, 0); });
  feed(401, 500, [](int i) { return Eigen::Vector3d(std::sin(0.02 * i), 0, 0); });
  EXPECT_EQ(gyro.spikes(), 1);
  feed(500, 600, [](int) { return Eigen::Vector3d(2, 0, 0); });  // a blow
  EXPECT_EQ(gyro.spikes(), 1);
  const auto over = gyro.rotation(1.9, 2.1, {});
  ASSERT_TRUE(over);
  EXPECT_NEAR(rotation_vector(over->R).y(), 0, 0.002);
}

}  // namespace
}  // namespace edgevo::test
