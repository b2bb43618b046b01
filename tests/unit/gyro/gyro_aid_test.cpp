// SPDX-License-Identifier: BSD-3-Clause
// A gyro that sits anywhere next to a camera: what rotations of the images show of it, by those of simulated
// gyros whose errors are known.
#include "edgevo/gyro/gyro_aid.h"

#include <gmock/gmock.h>

#include <cmath>

#include "unit/gyro/gyro_hand.h"

namespace edgevo::test {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

TEST(GyroAid, FindsRotationOffsetAndBiasOfEveryKind) {
  for (const std::string& kind : gyro_kinds())
    for (const uint64_t seed : {1, 2, 3}) {
      Placed b;
      b.kind = kind, b.seed = seed;
      const SimulatedGyro gyro = gyro_of(b);
      const GyroAid aid = follow(b, gyro);
      ASSERT_TRUE(aid.model()) << kind << seed << " " << aid.statement();
      const GyroModel& m = *aid.model();
      EXPECT_TRUE(m.is_observed());
      EXPECT_LT(deg((m.R_cam_gyro * gyro.truth.R_cam_gyro.conjugate()).vec().norm() * 2), 0.3)
          << kind << seed;
      EXPECT_NEAR(m.offset_s, gyro.truth.offset_s, 0.002) << kind << seed;
      EXPECT_LT(deg((m.errors.bias - gyro.last_bias).norm()), 0.05) << kind << seed;
    }
}

TEST(GyroAid, OnOneAxisTheRotationIsNotObservedButTurnsAreKnown) {
  Placed b;
  b.one_axis = true;
  const SimulatedGyro gyro = gyro_of(b);
  double worst = 0;
  const GyroAid aid = follow(b, gyro, [&](double t, const GyroAid& now) {
    if (t < 10) return;
    const auto turn = now.turn(Timestamp::from_seconds(t - 1), Timestamp::from_seconds(t));
    ASSERT_TRUE(turn);
    const Eigen::Quaterniond truth =
        hand_at(t, true).rotation().conjugate() * hand_at(t - 1, true).rotation();
    worst = std::max(worst, rotation_vector(turn->R * truth.conjugate()).norm());
  });
  ASSERT_TRUE(aid.model());
  EXPECT_FALSE(aid.model()->is_observed());
  EXPECT_THAT(aid.statement(), HasSubstr("not observed"));
  EXPECT_LT(deg(worst), 0.5);
}

TEST(GyroAid, CovariancesOfTurnsAreThoseOfTheirErrors) {
  Placed b;
  b.seconds = 30;
  const SimulatedGyro gyro = gyro_of(b);
  double squares = 0;
  int count = 0;
  follow(b, gyro, [&](double t, const GyroAid& now) {
    const auto turn = now.turn(Timestamp::from_seconds(t - 0.5), Timestamp::from_seconds(t));
    if (t < 5 || !turn) return;
    const Eigen::Quaterniond truth =
        hand_at(t, false).rotation().conjugate() * hand_at(t - 0.5, false).rotation();
    const Eigen::Vector3d error = rotation_vector(turn->R * truth.conjugate());
    squares += error.dot(turn->covariance.inverse() * error);
    ++count;
  });
  ASSERT_GT(count, 500);
  EXPECT_LT(squares / count, 2 * 3.0);
  EXPECT_GT(squares / count, 3.0 / 6);
}

// What rows of an image are rectified with: R(t + s) R(t)^T is nearly exp(s rate + s^2 / 2 turning).
TEST(GyroAid, PointsTurnAsItsRatesAndTheirChangeSay) {
  Placed b;
  b.seconds = 12;
  const SimulatedGyro gyro = gyro_of(b);
  const double half = 0.015;
  double squares = 0, squares_by_rate = 0;
  follow(b, gyro, [&](double t, const GyroAid& now) {
    const auto points = now.rate_of_points(Timestamp::from_seconds(t), 2 * half);
    if (t < 8 || !points) return;
    for (const double s : {-half, half}) {
      const Eigen::Quaterniond truth =
          hand_at(t + s, false).rotation().conjugate() * hand_at(t, false).rotation();
      const Eigen::Vector3d by_rate = s * points->rate, by_both = by_rate + 0.5 * s * s * points->turning;
      squares += rotation_vector(rotation_of(by_both) * truth.conjugate()).squaredNorm();
      squares_by_rate += rotation_vector(rotation_of(by_rate) * truth.conjugate()).squaredNorm();
    }
  });
  ASSERT_GT(squares, 0);
  EXPECT_LT(squares, 0.25 * squares_by_rate);
}

TEST(GyroAid, DegreesAreFoundAndConverted) {
  Placed b;
  b.change = [](size_t, GyroSample* s) { s->rate /= rad(1); };
  const GyroAid aid = follow(b, gyro_of(b));
  ASSERT_TRUE(aid.model()) << aid.statement();
  EXPECT_TRUE(aid.model()->is_observed());
}

TEST(GyroAid, AMirroredAxisIsNamedAndNotUsed) {
  Placed b;
  b.change = [](size_t, GyroSample* s) { s->rate.y() *= -1; };
  const GyroAid aid = follow(b, gyro_of(b));
  EXPECT_FALSE(aid.is_used());
  EXPECT_THAT(aid.statement(), HasSubstr("mirrored"));
}

TEST(GyroAid, AStuckGyroIsNamedAndNotUsed) {
  Placed b;
  b.change = [](size_t, GyroSample* s) { s->rate.setConstant(0.01); };
  const GyroAid aid = follow(b, gyro_of(b));
  EXPECT_FALSE(aid.is_used());
  EXPECT_THAT(aid.statement(), HasSubstr("stuck"));
}

// Of a robot that waits: its gyro rounds all rates to nothing.
TEST(GyroIntegrator, RatesThatRepeatAtRestAreNoGap) {
  for (const double rate : {0.0, 0.5}) {
    GyroIntegrator gyro;
    for (int i = 0; i < 500; ++i)
      gyro.add({Timestamp::from_seconds(0.01 * i), Eigen::Vector3d(0, i < 100 ? 0.001 * i + 1 : rate, 0)});
    const auto turn = gyro.rotation(2, 4, {});
    ASSERT_EQ(turn.has_value(), rate == 0) << "else it is stuck";
    if (turn) {
      EXPECT_LT(rotation_vector(turn->R).norm(), 1e-9);
    }
  }
}

TEST(GyroAid, OneThatRepeatsItsRatesAtRestIsNotStuck) {
  GyroAid aid;
  for (int i = 0; i < 300; ++i) {
    const Timestamp now = Timestamp::from_seconds(0.01 * i), next = Timestamp::from_seconds(0.01 * (i + 1));
    aid.add({next, Eigen::Vector3d(0.001, 0, 0)});
    aid.see(now, next, Eigen::Quaterniond::Identity(), 1e-8 * Eigen::Matrix3d::Identity());
  }
  EXPECT_THAT(aid.take_reports(), IsEmpty());
}

// Longer than samples are kept: turns of the first minute say nothing any more.
TEST(GyroAid, OnOneAxisItIsFollowedForMinutes) {
  Placed b;
  b.one_axis = true;
  b.seconds = 150;
  b.kind = "drone";
  double last = 0;
  const GyroAid aid = follow(b, gyro_of(b), [&](double t, const GyroAid& now) {
    const auto turn = now.turn(Timestamp::from_seconds(t - kFrame), Timestamp::from_seconds(t));
    if (!turn) return;
    last = t;
    const Eigen::Quaterniond truth =
        hand_at(t, true).rotation().conjugate() * hand_at(t - kFrame, true).rotation();
    const double off = rotation_vector(turn->R * truth.conjugate()).norm();
    EXPECT_LT(t > 100 ? off : 0, rad(0.1)) << t;
  });
  EXPECT_GT(last, 149) << aid.statement();
}

TEST(GyroAid, OneThatTurnsWithSomethingElseIsNamedAndNotUsed) {
  Placed b;
  b.change = [](size_t i, GyroSample* s) { s->rate = Eigen::Vector3d(std::sin(0.05 * double(i)), 0.1, 0); };
  const GyroAid aid = follow(b, gyro_of(b));
  EXPECT_FALSE(aid.is_used());
  EXPECT_THAT(aid.statement(), HasSubstr("does not turn"));
}

TEST(GyroAid, OneOfAnotherClockIsNamedWithTheOffset) {
  for (const double offset_s : {3.2, -2.5}) {
    Placed b;
    b.change = [offset_s](size_t, GyroSample* s) {
      s->time.ticks += int64_t(offset_s * Timestamp::kTicksPerSecond);
    };
    const GyroAid aid = follow(b, gyro_of(b));
    EXPECT_FALSE(aid.is_used());
    EXPECT_THAT(aid.statement(), HasSubstr(offset_s > 0 ? "3.2" : "2.5"));
    EXPECT_THAT(aid.statement(), HasSubstr(offset_s > 0 ? "ahead" : "behind"));
  }
}

TEST(GyroAid, OneThatFailsLaterIsNotUsedWithinTwoSeconds) {
  Placed b;
  b.seconds = 22;
  b.change = [](size_t i, GyroSample* s) {
    if (i > 4000) s->rate = Eigen::Vector3d(1e-4 * double(i % 7), 0, 0);
  };
  GyroAid aid = follow(b, gyro_of(b));
  EXPECT_FALSE(aid.is_used());
  EXPECT_THAT(aid.take_reports(), Contains(HasSubstr("not used")));
}

TEST(GyroAid, AClockThatIsLateIsFound) {
  Placed b;
  b.change = [](size_t, GyroSample* s) { s->time.ticks += Timestamp::kTicksPerSecond / 20; };
  const SimulatedGyro gyro = gyro_of(b);
  const GyroAid aid = follow(b, gyro);
  ASSERT_TRUE(aid.model());
  EXPECT_NEAR(aid.model()->offset_s, gyro.truth.offset_s + 0.05, 0.002);
}

TEST(GyroAid, ACameraThatStandsSaysNothing) {
  const SimulatedGyro still = simulate_gyro([](double) { return SE3(); }, 0, 10.5, "phone", 1);
  GyroAid aid;
  for (const GyroSample& s : still.samples) aid.add(s);
  Random random(1);
  for (double t = 0; t < 9.9; t += kFrame) {
    const Eigen::Vector3d noise(random.normal(), random.normal(), random.normal());
    aid.see(Timestamp::from_seconds(t), Timestamp::from_seconds(t + kFrame), rotation_of(kImageNoise * noise),
            kImageNoise * kImageNoise * Eigen::Matrix3d::Identity());
  }
  EXPECT_FALSE(aid.model());
  EXPECT_THAT(aid.take_reports(), IsEmpty());
}

TEST(GyroIntegrator, MissingSamplesGiveNoRotation) {
  GyroIntegrator gyro;
  for (int i = 0; i < 200; ++i)
    if (i < 80 || i > 120) gyro.add({Timestamp::from_seconds(0.005 * i), Eigen::Vector3d(0, 1, 1e-3 * i)});
  EXPECT_TRUE(gyro.rotation(0.1, 0.3, {}));
  EXPECT_TRUE(gyro.rotation(0.7, 0.9, {}));
  EXPECT_FALSE(gyro.rotation(0.3, 0.7, {}));
  EXPECT_FALSE(gyro.rotation(0.45, 0.5, {}));
  EXPECT_FALSE(gyro.rotation(0.9, 1.2, {}));
  EXPECT_FALSE(gyro.rotation(-0.1, 0.1, {}));
}

TEST(GyroIntegrator, DerivativesAreThoseOfDifferences) {
  GyroIntegrator gyro;
  for (int i = 0; i < 200; ++i) {
    const double t = 0.005 * i;
    gyro.add({Timestamp::from_seconds(t),
              Eigen::Vector3d(std::sin(7 * t), 2 * std::cos(5 * t), 1 - std::sin(3 * t))});
  }
  const auto at = [&](const GyroErrors& e) { return gyro.rotation(0.123, 0.777, e)->R; };
  const GyroRotation here = *gyro.rotation(0.123, 0.777, {});
  constexpr double kStep = 1e-5;
  for (int i = 0; i < 3; ++i) {
    GyroErrors bias, scale;
    bias.bias[i] = kStep, scale.scale[i] = kStep;
    const Eigen::Vector3d by_bias = rotation_vector(at(bias) * here.R.conjugate()) / kStep,
                          by_scale = rotation_vector(at(scale) * here.R.conjugate()) / kStep;
    EXPECT_LT((by_bias - here.by_bias.col(i)).norm(), 0.01);
    EXPECT_LT((by_scale - here.by_scale.col(i)).norm(), 0.01);
  }
}

}  // namespace
}  // namespace edgevo::test
