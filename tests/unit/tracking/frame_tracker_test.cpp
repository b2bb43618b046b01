// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/tracking/frame_tracker.h"

#include <gtest/gtest.h>

#include <cmath>

#include "edgevo/confidence/collect_evidence.h"
#include "edgevo/confidence/frame_status.h"
#include "edgevo/core/motion_history.h"
#include "edgevo/tracking/corner_search.h"
#include "support/plane_scene.h"
#include "support/twist.h"

namespace edgevo {
namespace {

using test::twist;

const SE3 kStep = SE3::exp(twist(0.02, 0, 0.04, 0, 0.01, 0));

// A camera in front of a plane that moves by kStep per frame; its reference is its pose two frames ago.
class FrameTracker : public ::testing::Test {
 protected:
  FrameTracker() {
    reference.cloud = scene.cloud(SE3());
    reference.known_points = int(reference.cloud.points.size());
    reference.T_keyframe_world[0] = SE3();
    for (int i = 0; i < 3; ++i) {
      motion.begin_frame(Timestamp::from_seconds(0.1 * i));
      if (i == 0) motion.restart(SE3());
      if (i > 0) motion.follow(i == 1 ? kStep : kStep * kStep);
    }
    motion.begin_frame(Timestamp::from_seconds(0.3));
  }

  // With a measured rotation that is `off` by radians about y, within `sigma`.
  Track track_turned(const FramePyramid& pyramid, double off, double sigma) {
    TrackingTask task{pyramid, reference, motion, {}, keyframes, params, {}, false, &random};
    task.turn = RotationPrior{(SE3::exp(twist(0, 0, 0, 0, off, 0)) * truth).rotation(),
                              Eigen::Matrix3d::Identity() / (sigma * sigma)};
    return track_frame(task);
  }

  Track track(const FramePyramid& pyramid, bool was_lost = false, const RowRectification& rows = {}) {
    return track_frame({pyramid, reference, motion, {}, keyframes, params, rows, was_lost, &random});
  }

  PoseSupport support(const Track& track) const { return classify(evidence_of(track.result), params.status); }

  test::PlaneScene scene;
  Reference reference;
  MotionModel motion;
  TrackingParams params;
  Random random{1};
  KeyframePolicy keyframes{scene.pyramid(SE3())->finest().pinhole, params.keyframe};
  const SE3 truth = kStep * kStep * kStep;
};

TEST_F(FrameTracker, FindsAFrameAtConstantVelocity) {
  const Track t = track(*scene.pyramid(truth.inverse()));
  EXPECT_EQ(support(t), PoseSupport::kGood);
  EXPECT_LT((t.result.T_cur_ref.translation() - truth.translation()).norm(), 0.01);
  EXPECT_FALSE(t.used_median_motion);
  EXPECT_EQ(t.corner_ms, 0) << "the edges explain the frame";
  EXPECT_LT((t.twist - kStep.log() / 0.1).norm(), 0.15);
}

TEST_F(FrameTracker, AHeldPoseStaysAndIsMeasured) {
  const SE3 near = SE3::exp(twist(0.004, 0, 0, 0, 0, 0)) * truth;
  const auto pyramid = scene.pyramid(truth.inverse());
  const Track held =
      zero_velocity_update({*pyramid, reference, motion, {}, keyframes, params, {}, false, &random}, near);
  EXPECT_TRUE(held.is_zero_velocity);
  EXPECT_EQ(held.result.T_cur_ref.translation(), near.translation());
  EXPECT_EQ(support(held), PoseSupport::kGood);
  EXPECT_TRUE(std::isfinite(held.result.sigmas.sum()));
  EXPECT_GT(held.result.sigmas.minCoeff(), 0);
}

TEST_F(FrameTracker, CornersGiveAHypothesisBeforeAFrameIsLostButNotAfter) {
  const auto black = scene.pyramid(SE3(), 0.0, 0.0);
  const Track about_to_be_lost = track(*black), lost_before = track(*black, true);
  EXPECT_TRUE(is_lost(support(about_to_be_lost)));
  EXPECT_GT(about_to_be_lost.corner_ms, 0);
  EXPECT_TRUE(is_lost(support(lost_before)));
  EXPECT_EQ(lost_before.corner_ms, 0);
}

TEST_F(FrameTracker, AJumpIsFoundByRotationSearch) {
  const SE3 turned = SE3::exp(twist(0, 0, 0, 0, 0.25, 0)) * kStep * kStep;
  const Track t = track(*scene.pyramid(turned.inverse()));
  EXPECT_FALSE(is_lost(support(t)));
  EXPECT_LT((t.result.T_cur_ref * turned.inverse()).angle(), 0.02);
}

TEST_F(FrameTracker, AMeasuredRotationCountsByItsCovariance) {
  const auto pyramid = scene.pyramid(truth.inverse());
  const Track alone = track(*pyramid);
  const auto from_alone = [&](const Eigen::Quaterniond& R) {
    return R.angularDistance(alone.result.T_cur_ref.rotation());
  };
  constexpr double kOff = 2e-3;
  const Track vague = track_turned(*pyramid, kOff, 1), sure = track_turned(*pyramid, kOff, 1e-4);
  EXPECT_LT(from_alone(vague.result.T_cur_ref.rotation()), 1e-4);
  EXPECT_GT(from_alone(sure.result.T_cur_ref.rotation()), 0.5 * kOff);
  EXPECT_LT(sure.result.covariance(4, 4), 1e-8);
  // What the image shows is the same whatever was measured.
  EXPECT_LT(from_alone(sure.by_image.R_cur_ref), 0.25 * kOff);
  EXPECT_EQ(alone.by_image.R_cur_ref.coeffs(), alone.result.T_cur_ref.rotation().coeffs());
}

TEST_F(FrameTracker, AMeasuredRotationFarFromTheImageGivesWay) {
  const Track t = track_turned(*scene.pyramid(truth.inverse()), 0.3, 1e-3);
  EXPECT_EQ(support(t), PoseSupport::kGood);
  EXPECT_LT((t.result.T_cur_ref * truth.inverse()).angle(), 0.02);
}

// Most of the map is turned by two degrees, and the edges follow it; the corners know better.
class ABentMap : public FrameTracker {
 protected:
  ABentMap() {
    bend(0.03);
    params.corners.max_inlier_share = 1;
    params.corners.min_agreeing = 30;
    params.keyframe.flow_px = 4.1;
  }

  // Turns three fifths of the map, by radians.
  void bend(double angle) {
    const Eigen::Matrix3d R = SE3::exp(twist(0, 0, 0, angle, 0, 0)).R();
    for (size_t i = 0; i < reference.cloud.points.size(); ++i) {
      if (i % 10 >= 6) continue;
      const Eigen::Vector3d ray = R * reference.cloud.points[i].ray;
      reference.cloud.points[i].ray = ray / ray.z();
    }
  }
  Track track(bool corners_later = false) {
    return track_frame({*pyramid, reference, motion, {}, often(), params, {}, false, &random, corners_later});
  }
  KeyframePolicy often() const {
    return KeyframePolicy(scene.pyramid(SE3())->finest().pinhole, params.keyframe);
  }
  double error_of(const SE3& T_cur_ref) const { return (T_cur_ref * truth.inverse()).angle(); }

  const std::shared_ptr<const FramePyramid> pyramid = scene.pyramid(truth.inverse());
};

TEST_F(ABentMap, DoesNotTurnTheCamera) {
  EXPECT_LT(error_of(track().result.T_cur_ref), 0.01);
  params.corners.min_agreeing = 10000;
  EXPECT_GT(error_of(track().result.T_cur_ref), 0.015) << "the edges alone follow the map";
}

TEST_F(ABentMap, DoesNotTurnTheCameraWhenItBeginsToBend) {
  bend(-0.015);  // of 0.03
  EXPECT_LT(error_of(track().result.T_cur_ref), 0.008);
  params.corners.min_agreeing = 10000;
  EXPECT_GT(error_of(track().result.T_cur_ref), 0.012) << "the edges alone follow the map";
}

// Nearly all of the edges fit the frame; where most depths are guesses, that says little.
TEST_F(ABentMap, IsHeldByCornersHoweverWellItsEdgesFitWhereMostDepthsAreGuesses) {
  params.corners.max_inlier_share = 0.01;
  EXPECT_EQ(track().corner_ms, 0);
  reference.known_points = int(reference.cloud.points.size()) / 2 - 1;
  EXPECT_GT(track().corner_ms, 0);
  EXPECT_LT(error_of(track().result.T_cur_ref), 0.01);
  params.corners.max_inlier_share = 0;
  EXPECT_EQ(track().corner_ms, 0) << "0: never";
}

TEST_F(ABentMap, GetsThePoseByItsEdgesFirstWhereCornersAreLeftForLater) {
  const Track by_edges = track(true);
  EXPECT_TRUE(by_edges.wants_corners);
  EXPECT_EQ(by_edges.corner_ms, 0);
  EXPECT_TRUE(by_edges.corners.empty());
  EXPECT_GT(error_of(by_edges.result.T_cur_ref), 0.015);
  EXPECT_FALSE(track().wants_corners) << "they were not left for later";
}

TEST_F(ABentMap, CornersFoundLaterMakeTheSamePose) {
  random = Random::derive(1, 4);
  const Track at_once = track();
  const Track first = track(true);
  ASSERT_TRUE(first.wants_corners);
  CornerSearch search(params, 1);
  EXPECT_FALSE(search.is_busy());
  const std::shared_future<PoseByCorners> later = search.begin(
      {pyramid, std::make_shared<const Reference>(reference), motion, {}, often(), {}, *first.wants_corners});
  const PoseByCorners& found = later.get();
  EXPECT_FALSE(search.is_busy());
  EXPECT_EQ(found.T_cam_ref.matrix(), at_once.result.T_cur_ref.matrix());
  EXPECT_EQ(found.covariance, at_once.result.covariance);
  EXPECT_EQ(found.corners.size(), at_once.corners.size());
  EXPECT_GE(found.corners.size(), 30u);
  EXPECT_GT(found.cpu_ms, 0);
}

TEST_F(FrameTracker, AFrameThatWouldBeLostDoesNotLeaveItsCornersForLater) {
  const auto black = scene.pyramid(SE3(), 0.0, 0.0);
  const Track t = track_frame({*black, reference, motion, {}, keyframes, params, {}, false, &random, true});
  EXPECT_TRUE(is_lost(support(t)));
  EXPECT_GT(t.corner_ms, 0);
  EXPECT_FALSE(t.wants_corners);
}

// The image was rectified for no motion, and a negligible read-out time shifts nothing.
TEST_F(FrameTracker, AFastShutterChangesNothing) {
  const auto pyramid = scene.pyramid(truth.inverse());
  const Track global = track(*pyramid), rolling = track(*pyramid, false, {1e-7, {}});
  EXPECT_LT((global.result.T_cur_ref.translation() - rolling.result.T_cur_ref.translation()).norm(), 1e-3);
  EXPECT_EQ(support(rolling), PoseSupport::kGood);
}

// The points are shifted to where the rows show them: a shutter that the image was not taken with moves the
// pose.
TEST_F(FrameTracker, ASlowShutterMovesThePose) {
  const auto pyramid = scene.pyramid(truth.inverse());
  const Track global = track(*pyramid), rolling = track(*pyramid, false, {0.05, {}, scene.camera});
  EXPECT_GT((global.result.T_cur_ref.translation() - rolling.result.T_cur_ref.translation()).norm(), 2e-3);
}

// All edges run along the motion and do not constrain it: after one odd step constant velocity predicts
// another, and only the steps before show otherwise.
class AlongTheEdges : public ::testing::Test {
 protected:
  AlongTheEdges() {
    camera.set_pinhole({260, 260, 159.5, 119.5, 320, 240});
    pyramid = PyramidBuilder(camera, EdgeParams()).build(test::make_image(320, 240, [](double x, double) {
      return 128 + 90 * std::sin(x / 6.0);
    }));
    std::vector<CloudPoint> points;
    for (size_t i = 0; i < pyramid->finest().edges.pixels.size(); i += 4) {
      const EdgePixel& e = pyramid->finest().edges.pixels[i];
      points.push_back(
          {camera.pinhole().ray(e.position().cast<double>()), 0.2, 0.001, e.position(), e.normal()});
    }
    reference.cloud = make_reference_cloud(pyramid, points, false);
    reference.T_keyframe_world[0] = SE3();
    motion.begin_frame(Timestamp::from_seconds(0));
    motion.restart(SE3());
    for (int i = 1; i <= 40; ++i) take_step(i, 0.01 + 0.0005 * (i % 3 - 1));
    motion.change_reference(motion.T_last_ref().inverse());
    take_step(41, 0.1, true);
    motion.begin_frame(Timestamp::from_seconds(4.2));
  }

  // `is_odd`: the step does not count for the standard deviation.
  void take_step(int frame, double length, bool is_odd = false) {
    motion.begin_frame(Timestamp::from_seconds(0.1 * frame));
    const SE3 T_cur_last = SE3::exp(twist(0, length, 0, 0, 0, 0));
    history.add({SE3(), T_cur_last, motion.frames_since(), false, is_odd});
    motion.follow(T_cur_last * motion.T_last_ref());
  }
  Track track(const TrackingParams& params) {
    const KeyframePolicy keyframes(camera.pinhole(), params.keyframe);
    return track_frame(
        {*pyramid, reference, motion, history.median_step(), keyframes, params, {}, false, &random});
  }
  double step_of(const Track& t) const {
    return (t.result.T_cur_ref * motion.T_last_ref().inverse()).translation().y();
  }

  Camera camera;
  std::shared_ptr<const FramePyramid> pyramid;
  Reference reference;
  MotionModel motion;
  MotionHistory history;
  Random random{1};
};

TEST_F(AlongTheEdges, TheMedianMotionIsTheBetterGuess) {
  TrackingParams params;
  const Track with_prior = track(params);
  params.alignment.use_median_motion_prior = false;
  const Track without = track(params);
  EXPECT_TRUE(with_prior.used_median_motion);
  EXPECT_NEAR(step_of(with_prior), 0.01, 0.005);
  EXPECT_FALSE(without.used_median_motion);
  EXPECT_NEAR(step_of(without), 0.1, 0.02);
}

TEST_F(FrameTracker, TheMeasuredMotionKeepsTheExpectedDepths) {
  const Pinhole pinhole = scene.pyramid(SE3())->finest().pinhole;
  const Vector6d t = twist(0.1, 0, 0.2, 0, 0, 0);
  RowRectification rows{0.02, {}, scene.camera};
  const Eigen::Vector3d turning(1, 2, 3);
  EXPECT_EQ(measured_motion(pinhole, reference, rows, SE3(), t, turning).velocity, t);
  EXPECT_EQ(measured_motion(pinhole, reference, rows, SE3(), t, turning).turning, turning);
  rows.expected.velocity = 2 * t;
  rows.expected.idepth.setConstant(0.7);
  const ImageMotion measured = measured_motion(pinhole, reference, rows, SE3(), t, turning);
  EXPECT_EQ(measured.velocity, t);
  EXPECT_EQ(measured.turning, turning);
  EXPECT_EQ(measured.idepth, rows.expected.idepth);
}

}  // namespace
}  // namespace edgevo
