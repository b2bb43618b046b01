// SPDX-License-Identifier: BSD-3-Clause
// The thread around the odometry does not change its results.
#include "edgevo/visp_bridge/servo_odometry.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <thread>

#include "edgevo/core/angle.h"
#include "edgevo/core/rotation_vector.h"
#include "edgevo/gyro/gyro_model.h"
#include "edgevo/visp_bridge/conversions.h"
#include "edgevo/visp_bridge/servo_params.h"
#include "map_of_desk.h"
#include "support/wait.h"

namespace edgevo {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

using test::desk;
using test::desk_frame;
using test::kDeskFrames;
using test::map_of_desk;

// Returns when the feed has the result of image `index`, or a failure; false after a minute.
bool wait_for(const ServoFeed& feed, int index) {
  return test::wait_until([&] {
    const ServoPose pose = feed.pose(Timestamp::from_seconds(0));
    return pose.frame_index >= index || pose.reason.find("Odometry::process()") == 0;
  });
}

TEST(ServoOdometry, FeedsTheResultsOfTheOdometry) {
  Odometry expected(desk().camera(), servo_odometry_params(), {});
  ServoFeed feed;
  ServoOdometry odometry(desk().camera(), servo_odometry_params(), {}, &feed);
  int posed = 0;
  for (int i = 0; i < 14; ++i) {
    const Timestamp time = Timestamp::from_seconds(i / 15.0);
    const GrayImage image = desk().render_image(2 * i);
    odometry.push(to_visp(image.view()), time);
    ASSERT_TRUE(wait_for(feed, i));
    const FrameRecord& record = expected.process({i, time, image});
    const ServoPose pose = feed.pose(time);
    EXPECT_EQ(pose.usable, record.T_world_cam_live.has_value());
    EXPECT_EQ(pose.state, record.state);
    if (!record.T_world_cam_live || !pose.usable) continue;
    ++posed;
    EXPECT_LT((to_se3(pose.cMw).matrix() - record.T_world_cam_live->inverse().matrix()).norm(), 1e-12);
    EXPECT_LT((pose.view.covariance - record.covariance).norm(), 1e-12);
    ASSERT_TRUE(pose.view.reference);
    EXPECT_GT(pose.view.reference->known_points, 100);
  }
  EXPECT_GE(posed, 5);
  EXPECT_EQ(odometry.replaced(), 0);
  EXPECT_EQ(odometry.finish().frames.size(), 14u);
}

// A gyro whose axes are those of the camera, as it turns from each image of the desk to the next.
std::vector<GyroSample> gyro_of_desk(int frames, double interval_s) {
  constexpr int kPerFrame = 10;
  std::vector<GyroSample> samples;
  for (int i = 0; i < kPerFrame * frames; ++i) {
    const SE3 T = desk().T_world_cam(2 * (i / kPerFrame)),
              T_next = desk().T_world_cam(2 * (i / kPerFrame) + 2);
    const Eigen::Vector3d turn = rotation_vector(T.rotation().conjugate() * T_next.rotation());
    samples.push_back({Timestamp::from_seconds((i + 0.5) * interval_s / kPerFrame), turn / interval_s});
  }
  return samples;
}

TEST(ServoOdometry, TakesAGyroAsTheOdometryDoes) {
  constexpr int kImages = 14;
  constexpr double kInterval = 1 / 15.0;
  OdometryOptions options;
  auto known = std::make_shared<GyroModel>(gyro_before_use());
  known->covariance *= 1e-4;
  options.gyro = known;
  Odometry expected(desk().camera(), servo_odometry_params(), options),
      without(desk().camera(), servo_odometry_params(), {});
  ServoFeed feed;
  ServoOdometry odometry(desk().camera(), servo_odometry_params(), options, &feed);
  const std::vector<GyroSample> samples = gyro_of_desk(kImages, kInterval);
  size_t next = 0;
  double apart = 0;  // of the poses with it and without
  for (int i = 0; i < kImages; ++i) {
    const Timestamp time = Timestamp::from_seconds(i * kInterval);
    for (; next < samples.size() && seconds_between(time, samples[next].time) < kInterval; ++next)
      odometry.push_gyro(samples[next]), expected.add_gyro(samples[next]);
    const GrayImage image = desk().render_image(2 * i);
    odometry.push(to_visp(image.view()), time);
    ASSERT_TRUE(wait_for(feed, i));
    const FrameRecord record = expected.process({i, time, image}), other = without.process({i, time, image});
    const ServoPose pose = feed.pose(time);
    ASSERT_EQ(pose.usable, record.T_world_cam_live.has_value());
    if (!pose.usable) continue;
    EXPECT_LT((to_se3(pose.cMw).matrix() - record.T_world_cam_live->inverse().matrix()).norm(), 1e-12);
    if (other.T_world_cam_live) apart += (record.covariance - other.covariance).norm();
  }
  EXPECT_GT(apart, 0);
}

TEST(ServoOdometry, FindsTheCameraInTheMapOfAnEarlierRun) {
  edgevo::Run before;
  const std::shared_ptr<const PlaceStore> kept = map_of_desk(&before);
  ASSERT_GE(kept->size(), 4u);
  const auto distance_before = [&](int a, int b) {
    return (before.frames[size_t(a)].T_world_cam->translation() -
            before.frames[size_t(b)].T_world_cam->translation())
        .norm();
  };
  constexpr int kFirst = 14;  // another first view, hence another frame and unit of the map
  ServoFeed feed, feed_without;
  ServoOdometry odometry(desk().camera(), servo_odometry_params(), {}, &feed, kept);
  ServoOdometry without(desk().camera(), servo_odometry_params(), {}, &feed_without);
  int found = 0;
  for (int i = kFirst; i < kDeskFrames; ++i) {
    const Frame frame = desk_frame(i);
    odometry.push(frame.image, frame.time), without.push(frame.image, frame.time);
    ASSERT_TRUE(wait_for(feed, i - kFirst) && wait_for(feed_without, i - kFirst));
    EXPECT_FALSE(feed_without.pose(frame.time).cMk);
    const ServoPose pose = feed.pose(frame.time);
    if (!pose.usable_in_kept || !pose.usable || !before.frames[size_t(i)].T_world_cam) continue;
    // What follows the velocity is by the run's own map.
    const ServoPose later = feed.pose(Timestamp::from_seconds(frame.time.seconds() + 0.03));
    found += later.cMk && (to_se3(*later.cMk).inverse() * to_se3(*pose.cMk)).translation().norm() > 0;
    const SE3 off = to_se3(*pose.cMk) * *before.frames[size_t(i)].T_world_cam;
    EXPECT_LT(off.translation().norm(), 0.05 * distance_before(kFirst, kDeskFrames - 1)) << i;
    EXPECT_LT(off.angle(), rad(1)) << i;
  }
  EXPECT_GE(found, 10);
}

TEST(ServoOdometry, LocatesAStandingCameraByTheMapOfAnEarlierRun) {
  edgevo::Run before;
  const std::shared_ptr<const PlaceStore> kept = map_of_desk(&before);
  constexpr int kStands = 30;
  ServoFeed feed;
  ServoOdometry odometry(desk().camera(), servo_odometry_params(), {}, &feed, kept);
  int located = 0;
  for (int i = 0; i < 8; ++i) {
    const Timestamp time = Timestamp::from_seconds(i / 30.0);
    odometry.push(desk().render_image(kStands), time);
    ASSERT_TRUE(wait_for(feed, i));
    const ServoPose pose = feed.pose(time);
    EXPECT_FALSE(pose.usable) << "no map is made of one view";
    ASSERT_EQ(pose.usable_in_kept, pose.cMk.has_value());
    if (!pose.usable_in_kept) continue;
    ++located;
    EXPECT_FALSE(feed.pose(Timestamp::from_seconds(time.seconds() + 5)).usable_in_kept) << "too old";
    const SE3 off = to_se3(*pose.cMk) * *before.frames[size_t(kStands)].T_world_cam;
    EXPECT_LT(off.translation().norm(), 0.2) << "of a median depth of some 10";
    EXPECT_LT(off.angle(), rad(0.5));
  }
  EXPECT_GE(located, 5);
}

TEST(ServoOdometry, TheNewestImageReplacesAWaitingOne) {
  ServoFeed feed;
  ServoOdometry odometry(desk().camera(), servo_odometry_params(), {}, &feed);
  const GrayImage image = desk().render_image(0);
  for (int i = 0; i < 40; ++i) odometry.push(image, Timestamp::from_seconds(0.01 * i));
  const edgevo::Run run = odometry.finish();
  EXPECT_EQ(int(run.frames.size()) + odometry.replaced(), 40);
  EXPECT_GT(odometry.replaced(), 0);
  EXPECT_EQ(run.frames.back().index, 39) << "the last one is never replaced";
}

TEST(ServoOdometry, AnInvalidImageIsReportedByTheFeed) {
  ServoFeed feed;
  ServoOdometry odometry(desk().camera(), servo_odometry_params(), {}, &feed);
  odometry.push(vpImage<vpRGBa>(3, 5, vpRGBa(1, 2, 3)), Timestamp::from_seconds(0));
  ASSERT_TRUE(wait_for(feed, 0));
  EXPECT_THAT(feed.pose(Timestamp::from_seconds(0)).reason, HasSubstr("5x3"));
  EXPECT_TRUE(odometry.finish().frames.empty());
}

TEST(ServoOdometry, AClockThatIsSetBackDoesNotEndTheLoop) {
  ServoFeed feed;
  ServoOdometry odometry(desk().camera(), servo_odometry_params(), {}, &feed);
  const GrayImage image = desk().render_image(0);
  const auto push = [&](double s) {
    odometry.push(image, Timestamp::from_seconds(s));
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  };
  for (int k = 0; k < 40; ++k) push(5 + 0.01 * k);
  for (int k = 0; k < 400; ++k) push(2 + 0.01 * k);
  const edgevo::Run run = odometry.finish();
  EXPECT_EQ(int(run.frames.size()) + odometry.replaced(), 440);
  EXPECT_EQ(run.frames.back().index, 439);
  EXPECT_LT(Timestamp::from_seconds(5), run.frames.back().time);
  EXPECT_THAT(run.frames.back().note, Not(HasSubstr("left out")));
}

TEST(ServoOdometry, AnImageWithFewerPixelsThanItsSizeIsRefused) {
  GrayImage image{64, 48, std::vector<uint8_t>(1000)};
  EXPECT_THROW(share_with_visp(image), InputError);
}

}  // namespace
}  // namespace edgevo
