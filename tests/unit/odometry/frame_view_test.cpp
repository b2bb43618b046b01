// SPDX-License-Identifier: BSD-3-Clause
// What displays and live recorders see while a run goes on.
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "unit/odometry/rendered_runs.h"

namespace edgevo {
namespace {

using test::sweep_camera;
using test::sweep_frame;

constexpr int kFrames = 60;

TEST(FrameView, IsEmptyBeforeTheFirstFrameAndWithoutAMap) {
  Odometry odometry(sweep_camera(), {}, {});
  EXPECT_FALSE(odometry.frame_view().pyramid);
  odometry.process(sweep_frame(0));
  const FrameView view = odometry.frame_view();
  ASSERT_TRUE(view.pyramid);
  EXPECT_TRUE(view.points.empty());
  EXPECT_EQ(view.reference_keyframe, -1);
  EXPECT_TRUE(odometry.marginalised_keyframes().keyframes.empty());
}

TEST(FrameView, HoldsPointsThatLieOnTheEdgesOfTheFrame) {
  Odometry odometry(sweep_camera(), {}, {});
  const FrameRecord* record = nullptr;
  for (int k = 0; k < kFrames; ++k) record = &odometry.process(sweep_frame(k));
  ASSERT_EQ(record->state, TrackingState::kTracking);
  const FrameView view = odometry.frame_view();
  EXPECT_GE(view.reference_keyframe, 0);
  ASSERT_GT(view.points.size(), 200u);
  int on_an_edge = 0;
  for (const SeenPoint& p : view.points) {
    ASSERT_TRUE(sweep_camera().pinhole.contains(p.px.cast<double>()));
    ASSERT_GT(p.idepth, 0);
    ASSERT_GT(p.idepth_sigma, 0);
    on_an_edge += std::abs(p.residual_px) < 1.5f;  // false for NaN
  }
  EXPECT_GT(on_an_edge, 0.7 * double(view.points.size()));
}

// They equal those of the finished run unless a correction of the camera has moved them.
TEST(FrameView, MarginalisedKeyframesAreThoseOfTheFinishedRun) {
  OdometryParams params;
  params.camera.refine = "none";
  Odometry odometry(sweep_camera(), params, {});
  std::vector<KeyframeRecord> marginalised;
  for (int k = 0; k < 110; ++k) {
    odometry.process(sweep_frame(k));
    for (KeyframeRecord& keyframe : odometry.marginalised_keyframes(marginalised.size()).keyframes)
      marginalised.push_back(std::move(keyframe));
  }
  EXPECT_EQ(odometry.marginalised_keyframes(marginalised.size()).keyframes.size(), 0u);
  EXPECT_EQ(odometry.marginalised_keyframes().keyframes.size(), marginalised.size());
  const edgevo::Run run = odometry.finish();
  ASSERT_FALSE(marginalised.empty());
  for (const KeyframeRecord& keyframe : marginalised) {
    const auto same = std::find_if(run.keyframes.begin(), run.keyframes.end(), [&](const KeyframeRecord& k) {
      return k.frame_index == keyframe.frame_index;
    });
    ASSERT_NE(same, run.keyframes.end());
    EXPECT_LT((same->T_world_cam.inverse() * keyframe.T_world_cam).log().norm(), 1e-9);
    EXPECT_EQ(same->points.size(), keyframe.points.size());
  }
}

// What would be left of the map if the program ended now: every keyframe so far, marginalised or in the
// window.
TEST(FrameView, MarginalisedAndActiveKeyframesAreAllKeyframes) {
  OdometryParams params;
  params.camera.refine = "none";
  Odometry odometry(sweep_camera(), params, {});
  EXPECT_FALSE(odometry.active_keyframes());
  std::set<int> called;
  ActiveKeyframes window;
  for (int k = 0; k < 110; ++k) {
    const FrameRecord& record = odometry.process(sweep_frame(k));
    if (auto changed = odometry.active_keyframes(window.version)) window = std::move(*changed);
    EXPECT_FALSE(odometry.active_keyframes(window.version)) << "nothing has changed since";
    if (record.T_world_cam_live && record.keyframe_reason != KeyframeReason::kNone &&
        record.keyframe_reason != KeyframeReason::kReturn)
      called.insert(record.index);
    std::set<int> there;
    for (const KeyframeRecord& kf : odometry.marginalised_keyframes().keyframes) there.insert(kf.frame_index);
    for (const KeyframeRecord& kf : window.keyframes)
      EXPECT_TRUE(there.insert(kf.frame_index).second) << "both marginalised and not: " << kf.frame_index;
    for (const int index : called) ASSERT_TRUE(there.count(index)) << index << " at frame " << k;
  }
  ASSERT_GT(called.size(), 8u);
  EXPECT_EQ(window.keyframes.size(), size_t(params.mapping.window.keyframes));
  // Near the poses of the finished run, and with most of their points.
  const edgevo::Run run = odometry.finish();
  size_t points = 0, final_points = 0;
  for (const KeyframeRecord& kf : window.keyframes) {
    const auto same = std::find_if(run.keyframes.begin(), run.keyframes.end(),
                                   [&](const KeyframeRecord& k) { return k.frame_index == kf.frame_index; });
    ASSERT_NE(same, run.keyframes.end());
    EXPECT_LT((same->T_world_cam.inverse() * kf.T_world_cam).log().norm(), 1e-9);
    points += kf.points.size(), final_points += same->points.size();
  }
  EXPECT_GT(points, 300u);
  EXPECT_EQ(points, final_points) << "the last window is closed as it stands";
  EXPECT_TRUE(odometry.active_keyframes(window.version)->keyframes.empty());
}

}  // namespace
}  // namespace edgevo
