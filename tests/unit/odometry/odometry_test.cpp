// SPDX-License-Identifier: BSD-3-Clause
// The odometry from end to end on rendered sequences.
#include "edgevo/odometry/odometry.h"

#include <gmock/gmock.h>

#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "unit/odometry/rendered_runs.h"

namespace edgevo {
namespace {

using test::run_sweep;
using test::sweep_frame;
using test::sweep_pose;
using test::trajectory_error;

constexpr int kSweepFrames = 110;  // a path of about 3.5

const Run& whole_sweep() {
  static const auto run = run_sweep(kSweepFrames);
  return run;
}

int count(const Run& run, TrackingState state, int begin = 0, int end = 1 << 30) {
  int n = 0;
  for (const FrameRecord& f : run.frames) n += f.index >= begin && f.index < end && f.state == state;
  return n;
}

// ---- an undisturbed run ----

TEST(Odometry, EveryFrameHasARecordInOrder) {
  const auto& run = whole_sweep();
  ASSERT_EQ(run.frames.size(), size_t(kSweepFrames));
  for (int k = 0; k < kSweepFrames; ++k) {
    const FrameRecord& f = run.frames[size_t(k)];
    EXPECT_EQ(f.index, k);
    EXPECT_EQ(f.time, sweep_frame(k).time);
    EXPECT_GT(f.evidence.edges, 500);
    ASSERT_FALSE(f.stage_ms.empty());
    EXPECT_EQ(f.stage_ms.front().first, "edges");
  }
}

TEST(Odometry, FollowsTheSweepFromItsFirstFrame) {
  const auto& run = whole_sweep();
  for (const FrameRecord& f : run.frames) {
    EXPECT_EQ(f.state, TrackingState::kTracking) << f.index << " " << f.note;
    EXPECT_EQ(f.segment, 0);
    ASSERT_TRUE(f.T_world_cam) << f.index;
    EXPECT_TRUE(f.T_world_cam->is_finite());
    EXPECT_TRUE(f.T_world_cam_live);
  }
  EXPECT_LT(run.frames.front().T_world_cam->log().norm(), 1e-9);
  const auto e = trajectory_error(run, 0, kSweepFrames, sweep_pose);
  EXPECT_EQ(e.poses, kSweepFrames);
  EXPECT_LT(e.rmse, 0.02 * e.length);
}

TEST(Odometry, TheRotationsAreThoseOfTheSweep) {
  double worst = 0;
  for (const FrameRecord& f : whole_sweep().frames)
    worst = std::max(worst, (*f.T_world_cam * sweep_pose(f.index).inverse()).angle());
  EXPECT_LT(worst, 0.02);
}

// A view wider by a tenth in a smaller image: the outermost pixels have no source.
TEST(Odometry, FollowsTheSweepInAPinholeOfAnotherSizeAndFocalLength) {
  OdometryOptions options;
  options.working_pinhole = Pinhole{204, 206, 138.2, 106.3, 280, 210};
  const auto run = run_sweep(kSweepFrames, options);
  EXPECT_TRUE(run.pinhole == *options.working_pinhole);
  const auto e = trajectory_error(run, 0, kSweepFrames, sweep_pose);
  EXPECT_EQ(e.poses, kSweepFrames);
  EXPECT_LT(e.rmse, 0.02 * e.length);
  for (const KeyframeRecord& k : run.keyframes)
    for (const EdgePoint& p : k.points) EXPECT_TRUE(run.pinhole.contains(p.px.cast<double>()));
}

TEST(Odometry, KeyframesCarryPointsWithTrueDepth) {
  const auto& run = whole_sweep();
  const test::HollowScene scene;
  ASSERT_GT(run.keyframes.size(), 4u);
  const double scale = trajectory_error(run, 0, kSweepFrames, sweep_pose).scale;
  std::vector<double> error;
  for (size_t i = 0; i < run.keyframes.size(); ++i) {
    const KeyframeRecord& k = run.keyframes[i];
    EXPECT_TRUE(run.frames[size_t(k.frame_index)].is_keyframe);
    EXPECT_GT(k.frame_index, i > 0 ? run.keyframes[i - 1].frame_index : -1);
    for (const EdgePoint& p : k.points) {
      EXPECT_GT(p.idepth, 0);
      if (p.observations == 0) continue;  // passed on, and not matched since
      error.push_back(std::abs(
          double(p.idepth) / scale / scene.idepth(sweep_pose(k.frame_index), p.px.cast<double>()) - 1));
    }
  }
  ASSERT_GT(error.size(), 400u);
  std::nth_element(error.begin(), error.begin() + long(error.size() / 2), error.end());
  EXPECT_LT(error[error.size() / 2], 0.05);
}

TEST(Odometry, TheFrameOfAKeyframeHasItsPose) {
  const auto& run = whole_sweep();
  for (size_t i = 0; i < run.keyframes.size(); ++i) {
    const FrameRecord& f = run.frames[size_t(run.keyframes[i].frame_index)];
    EXPECT_EQ(f.reference_keyframe, int(i));
    EXPECT_LT((f.T_world_cam->inverse() * run.keyframes[i].T_world_cam).log().norm(), 1e-12);
  }
}

TEST(Odometry, TheReferencesOfFramesExist) {
  const auto& run = whole_sweep();
  for (const FrameRecord& f : run.frames) {
    ASSERT_GE(f.reference_keyframe, 0);
    ASSERT_LT(f.reference_keyframe, int(run.keyframes.size()));
    EXPECT_EQ(run.keyframes[size_t(f.reference_keyframe)].segment, f.segment);
  }
}

void expect_equal_runs(const Run& a, const Run& b) {
  ASSERT_EQ(a.frames.size(), b.frames.size());
  for (size_t i = 0; i < a.frames.size(); ++i) {
    const FrameRecord &fa = a.frames[i], &fb = b.frames[i];
    EXPECT_EQ(fa.state, fb.state);
    EXPECT_EQ(fa.segment, fb.segment);
    EXPECT_EQ(fa.is_keyframe, fb.is_keyframe);
    EXPECT_EQ(fa.evidence.inlier_share, fb.evidence.inlier_share);
    EXPECT_EQ(fa.evidence.residual_px, fb.evidence.residual_px);
    EXPECT_EQ(fa.note, fb.note);
    EXPECT_EQ(fa.covariance, fb.covariance);
    ASSERT_EQ(fa.T_world_cam.has_value(), fb.T_world_cam.has_value());
    EXPECT_EQ(fa.T_world_cam.value_or(SE3()).matrix(), fb.T_world_cam.value_or(SE3()).matrix()) << i;
  }
  ASSERT_EQ(a.keyframes.size(), b.keyframes.size());
  for (size_t i = 0; i < a.keyframes.size(); ++i) {
    ASSERT_EQ(a.keyframes[i].points.size(), b.keyframes[i].points.size());
    for (size_t k = 0; k < a.keyframes[i].points.size(); ++k) {
      EXPECT_EQ(a.keyframes[i].points[k].idepth, b.keyframes[i].points[k].idepth);
      EXPECT_EQ(a.keyframes[i].points[k].idepth_sigma, b.keyframes[i].points[k].idepth_sigma);
    }
  }
}

TEST(Odometry, TwoRunsAreIdentical) { expect_equal_runs(whole_sweep(), run_sweep(kSweepFrames)); }

// ---- evidence ----

TEST(Odometry, EveryTrackedFrameHasEvidence) {
  for (const FrameRecord& f : whole_sweep().frames) {
    const FrameEvidence& e = f.evidence;
    EXPECT_GT(e.visible_points.value_or(0), 60) << f.index;
    EXPECT_LE(e.matched_points.value_or(0), e.visible_points.value_or(0)) << f.index;
    EXPECT_GT(e.known_points.value_or(0), 0) << f.index;
    EXPECT_GE(e.lacking_share, 0) << f.index;
    EXPECT_LT(e.lacking_share, 1) << f.index;
    EXPECT_GT(e.view_share, 0.15) << f.index;
    EXPECT_GT(e.pose_sigmas.front(), 0) << f.index;
    EXPECT_LE(e.pose_sigmas.back(), 0.01) << "no weak direction in frame " << f.index;
    EXPECT_LT(e.saturated_share, 0.5) << f.index;
    EXPECT_GT(e.edge_blur, 0) << f.index;
    EXPECT_LT(e.edge_blur, 1) << f.index;
  }
}

TEST(Odometry, CornersAgreeWithRightPosesAndCanBeSwitchedOff) {
  int agreeing = 0, compared = 0;
  for (const FrameRecord& f : whole_sweep().frames) {
    if (!f.evidence.corners || std::isnan(f.evidence.corners->change_10)) continue;
    const CornerEvidence& c = *f.evidence.corners;
    ++compared;
    agreeing += std::abs(c.change_10) < 3 * c.change_10_sigma && c.rotation_deg < 3;
  }
  EXPECT_GT(compared, kSweepFrames / 3);
  EXPECT_GE(agreeing, 0.95 * compared);
  OdometryParams params;
  params.health.corners = false;
  for (const FrameRecord& f : run_sweep(30, {}, 0, 0, params).frames) EXPECT_FALSE(f.evidence.corners);
}

TEST(Odometry, KeyframesHaveTheEvidenceOfTheirAdjustment) {
  int adjusted = 0;
  for (const FrameRecord& f : whole_sweep().frames) {
    const auto& adjustment = f.evidence.adjustment;
    const bool is_made = f.is_keyframe && f.keyframe_reason != KeyframeReason::kBootstrap;
    EXPECT_EQ(adjustment.has_value(), is_made) << f.index;
    if (!adjustment) continue;
    ++adjusted;
    EXPECT_GE(adjustment->moved, 0);
    EXPECT_LT(adjustment->moved, 100);
    EXPECT_GT(adjustment->cost_per_match, 0);
    EXPECT_LT(adjustment->cost_per_match, 2);
    EXPECT_GT(adjustment->points, 100);
    EXPECT_GT(adjustment->matches, adjustment->points);
    EXPECT_GT(adjustment->matches_in_newest, 50);
  }
  EXPECT_GT(adjusted, 2);
}

// An image in the middle of the sweep, changed.
FrameEvidence evidence_with(const std::function<void(GrayImage*)>& change) {
  constexpr int kChanged = 20;
  Odometry odometry(test::sweep_camera(), {}, {});
  for (int k = 0; k < kChanged; ++k) odometry.process(sweep_frame(k));
  Frame frame = sweep_frame(kChanged);
  change(&frame.image);
  return odometry.process(frame).evidence;
}

TEST(Odometry, TheEvidenceShowsBlurAndOverexposure) {
  const FrameEvidence as_is = evidence_with([](GrayImage*) {});
  const FrameEvidence blurred = evidence_with([](GrayImage* image) {
    constexpr int kReach = 5;
    const std::vector<uint8_t> before = image->pixels;
    for (size_t i = kReach; i + kReach < before.size(); ++i) {
      int sum = 0;
      for (size_t k = i - kReach; k <= i + kReach; ++k) sum += before[k];
      image->pixels[i] = uint8_t(sum / (2 * kReach + 1));
    }
  });
  const FrameEvidence bright = evidence_with([](GrayImage* image) {
    for (uint8_t& gray : image->pixels) gray = uint8_t(std::min(255, 2 * gray));
  });
  EXPECT_GT(blurred.edge_blur, as_is.edge_blur);
  EXPECT_LT(blurred.inlier_share, as_is.inlier_share);
  EXPECT_GT(bright.saturated_share, as_is.saturated_share + 0.1);
}

TEST(Odometry, AFrameWithoutAMapHasTheEvidenceOfItsImageOnly) {
  Odometry odometry(test::sweep_camera(), {}, {});
  const FrameEvidence e = odometry.process(sweep_frame(0)).evidence;
  EXPECT_GT(e.edges, 500);
  EXPECT_GT(e.edge_blur, 0);
  EXPECT_FALSE(e.visible_points);
  EXPECT_FALSE(e.known_points);
  EXPECT_TRUE(std::isnan(e.pose_sigmas.back()));
  EXPECT_TRUE(std::isnan(e.view_share));
}

// ---- loss ----

TEST(OdometryLoss, FortyBlackFramesAreLostAndTrackingResumes) {
  constexpr int kBegin = 45, kEnd = 85, kAll = 150;
  const auto run = run_sweep(kAll, {}, kBegin, kEnd);
  ASSERT_EQ(run.frames.size(), size_t(kAll));
  for (int k = kBegin; k < kEnd; ++k) {
    EXPECT_EQ(run.frames[size_t(k)].state, TrackingState::kLost) << k;
    EXPECT_FALSE(run.frames[size_t(k)].T_world_cam) << k;
    EXPECT_NE(run.frames[size_t(k)].note, "") << k;
  }
  const auto before = trajectory_error(run, 0, kBegin, sweep_pose),
             after = trajectory_error(run, kEnd, kAll, sweep_pose);
  EXPECT_EQ(before.poses, kBegin);
  EXPECT_LT(before.rmse, 0.03 * before.length);
  EXPECT_GT(after.poses, (kAll - kEnd) / 2);
  EXPECT_LT(after.rmse, 0.05 * after.length);
  EXPECT_EQ(count(run, TrackingState::kLost, 0, kBegin), 0);
  EXPECT_EQ(run.frames.back().state, TrackingState::kTracking);
  EXPECT_EQ(run.frames.back().segment, 0);  // the hollow is still in view: relocalised
  bool first_segment_kept = false;
  for (const KeyframeRecord& k : run.keyframes) first_segment_kept |= k.segment == 0 && !k.points.empty();
  EXPECT_TRUE(first_segment_kept);
  for (const FrameRecord& f : run.frames) {
    if (!f.T_world_cam) continue;
    EXPECT_EQ(run.keyframes[size_t(f.reference_keyframe)].segment, f.segment) << f.index;
  }
}

TEST(OdometryLoss, TheNewSegmentLiesWhereBothMapsSeeIt) {
  constexpr int kBegin = 45, kEnd = 85;
  OdometryParams params;
  params.recovery.max_frames = 0;  // no relocalisation
  const auto run = run_sweep(130, {}, kBegin, kEnd, params);
  const FrameRecord* restarted = nullptr;
  for (const FrameRecord& f : run.frames)
    if (!restarted && f.segment == 1 && f.T_world_cam) restarted = &f;
  ASSERT_TRUE(restarted);
  // The camera turns meanwhile: constant velocity would put it elsewhere by more than half of the way.
  const auto truth = [](int f) { return test::sweep_pose(f).translation(); };
  const double unit =
      run.frames[kBegin - 1].T_world_cam_live->translation().norm() / truth(kBegin - 1).norm();
  const Eigen::Vector3d way = unit * (truth(restarted->index) - truth(kBegin - 1));
  const Eigen::Vector3d error = restarted->T_world_cam->translation() - unit * truth(restarted->index);
  EXPECT_LT(error.norm(), 0.5 * way.norm());
  // Once it is sure, its unit of length is compared with that of the map before.
  const auto compared = std::find_if(run.frames.begin(), run.frames.end(),
                                     [](const FrameRecord& f) { return f.evidence.unit.has_value(); });
  ASSERT_NE(compared, run.frames.end());
  EXPECT_EQ(compared->segment, 1);
  ASSERT_TRUE(compared->evidence.unit->is_linked());
  EXPECT_NEAR(std::log(compared->evidence.unit->ratio), 0, 0.2);
}

TEST(OdometryLoss, OneBlackFrameCostsItselfAlone) {
  constexpr int kBlack = 60, kAll = 80;
  std::vector<std::string> log;
  OdometryOptions options;
  options.log = [&](const std::string& line) { log.push_back(line); };
  const auto run = run_sweep(kAll, options, kBlack, kBlack + 1);
  EXPECT_EQ(run.frames[kBlack].state, TrackingState::kLost);
  for (int k = 0; k < kAll; ++k) {
    if (k == kBlack) continue;
    EXPECT_EQ(run.frames[size_t(k)].segment, 0) << k;
    EXPECT_TRUE(run.frames[size_t(k)].T_world_cam) << k;
  }
  const auto e = trajectory_error(run, 0, kAll, sweep_pose);
  EXPECT_LT(e.rmse, 0.03 * e.length);
  EXPECT_THAT(run.frames[kBlack].note, ::testing::HasSubstr("blank"));
  EXPECT_THAT(log, ::testing::Not(::testing::Contains(::testing::HasSubstr("relocalised"))));
}

TEST(OdometryLoss, BlackFramesAtTheEndEndTheRunNormally) {
  const auto run = run_sweep(60, {}, 45, 60);
  EXPECT_EQ(run.frames.size(), 60u);
  EXPECT_EQ(count(run, TrackingState::kLost, 45, 60), 15);
  EXPECT_EQ(trajectory_error(run, 0, 45, sweep_pose).poses, 45);
  EXPECT_FALSE(run.keyframes.empty());
}

TEST(OdometryLoss, RepeatedBlackoutsKeepEverySegment) {
  OdometryParams params;
  params.recovery.max_frames = 0;
  Odometry odometry(test::sweep_camera(), params, OdometryOptions());
  constexpr int kPeriod = 50, kBlack = 15, kAll = 150;
  for (int k = 0; k < kAll; ++k)
    odometry.process(k % kPeriod >= kPeriod - kBlack ? test::black(sweep_frame(k)) : sweep_frame(k));
  const auto run = odometry.finish();
  ASSERT_EQ(run.frames.size(), size_t(kAll));
  int segment = -1;
  for (const FrameRecord& f : run.frames) {
    if (f.segment >= 0) {
      EXPECT_GE(f.segment, segment);
      segment = std::max(segment, f.segment);
    }
    const bool is_black = f.index % kPeriod >= kPeriod - kBlack;
    EXPECT_TRUE(!is_black || f.state == TrackingState::kLost) << f.index;
    EXPECT_TRUE(f.T_world_cam.value_or(SE3()).is_finite());
  }
  EXPECT_GE(segment, 1);
}

// ---- no motion, no image ----

TEST(OdometryStart, AStandstillKeepsBootstrappingAndReportsWhy) {
  Odometry odometry(test::sweep_camera(), OdometryParams(), OdometryOptions());
  for (int k = 0; k < 12; ++k) {
    Frame frame = sweep_frame(0);
    frame.index = k;
    frame.time = sweep_frame(k).time;
    const FrameRecord& record = odometry.process(frame);
    EXPECT_EQ(record.state, TrackingState::kBootstrapping);
    EXPECT_NE(record.note, "");
  }
  const auto run = odometry.finish();
  EXPECT_EQ(run.frames.size(), 12u);
  EXPECT_TRUE(run.keyframes.empty());
}

TEST(OdometryStart, ARunWithoutFramesIsEmpty) {
  Odometry odometry(test::sweep_camera(), OdometryParams(), OdometryOptions());
  const auto run = odometry.finish();
  EXPECT_TRUE(run.frames.empty());
  EXPECT_TRUE(run.keyframes.empty());
}

TEST(OdometryStart, WaitsThroughBlackFrames) {
  const auto run = run_sweep(40, {}, 0, 10);
  EXPECT_EQ(count(run, TrackingState::kBootstrapping, 0, 10), 10);
  EXPECT_EQ(run.frames.back().state, TrackingState::kTracking);
}

}  // namespace
}  // namespace edgevo
