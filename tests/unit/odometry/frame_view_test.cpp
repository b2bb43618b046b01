// SPDX-License-Identifier: BSD-3-Clause
// What displays and live recorders see while a run goes on: the frame, and the events of the map.
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <set>

#include "edgevo/map/map_log.h"
#include "edgevo/tracking/frame_view.h"
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
}

TEST(FrameView, HoldsPointsThatLieOnTheEdgesOfTheFrame) {
  Odometry odometry(sweep_camera(), {}, {});
  FrameRecord record;
  for (int k = 0; k < kFrames; ++k) record = odometry.process(sweep_frame(k));
  ASSERT_EQ(record.state, TrackingState::kTracking);
  const FrameView view = odometry.frame_view();
  EXPECT_GE(view.reference_keyframe, 0);
  ASSERT_GT(view.points.size(), 200u);
  int on_an_edge = 0;
  for (const SeenPoint& p : view.points) {
    ASSERT_TRUE(sweep_camera().pinhole().contains(p.px.cast<double>()));
    ASSERT_GT(p.idepth, 0);
    ASSERT_GT(p.idepth_sigma, 0);
    on_an_edge += std::abs(p.residual_px) < 1.5f;  // false for NaN
  }
  EXPECT_GT(on_an_edge, 0.7 * double(view.points.size()));
}

// A consumer's copy of the map: the marginalised keyframes, and those of the window.
struct Copy {
  std::map<int, std::shared_ptr<const KeyframeRecord>> marginalised;
  WindowAdjusted window;

  void apply(const MapEvent& event) {
    if (const auto* e = std::get_if<KeyframeMarginalised>(&event)) marginalised[e->id] = e->keyframe;
    if (const auto* e = std::get_if<WindowAdjusted>(&event)) window = *e;
  }
  std::set<int> frames() const {
    std::set<int> indices;
    for (const auto& [id, keyframe] : marginalised) indices.insert(keyframe->frame_index);
    for (const WindowAdjusted::Active& a : *window.keyframes) indices.insert(a.keyframe.frame_index);
    return indices;
  }
};

void expect_in(const edgevo::Run& run, const KeyframeRecord& keyframe) {
  const auto same = std::find_if(run.keyframes.begin(), run.keyframes.end(), [&](const KeyframeRecord& k) {
    return k.frame_index == keyframe.frame_index;
  });
  ASSERT_NE(same, run.keyframes.end());
  EXPECT_LT((same->T_world_cam.inverse() * keyframe.T_world_cam).log().norm(), 1e-9);
  EXPECT_EQ(same->points.size(), keyframe.points.size());
}

// What would be left of the map if the program ended now: every keyframe so far, marginalised or in the
// window. Without a move of the map they equal those of the finished run.
TEST(MapEvents, MarginalisedAndActiveKeyframesAreAllKeyframes) {
  OdometryParams params;
  params.camera.refine = "none";
  OdometryOptions options;
  options.map_log = std::make_shared<MapLog>();
  MapCursor cursor(options.map_log);
  Odometry odometry(sweep_camera(), params, options);
  std::set<int> called;
  Copy copy;
  for (int k = 0; k < 110; ++k) {
    const FrameRecord record = odometry.process(sweep_frame(k));
    for (const auto& event : cursor.read()) copy.apply(*event);
    if (record.T_world_cam_live && record.keyframe_reason != KeyframeReason::kNone &&
        record.keyframe_reason != KeyframeReason::kReturn)
      called.insert(record.index);
    if (!copy.window.keyframes) continue;
    const std::set<int> there = copy.frames();
    EXPECT_EQ(there.size(), copy.marginalised.size() + copy.window.keyframes->size());
    for (const int index : called) ASSERT_TRUE(there.count(index)) << index << " at frame " << k;
  }
  ASSERT_GT(called.size(), 8u);
  ASSERT_FALSE(copy.marginalised.empty());
  EXPECT_EQ(copy.window.keyframes->size(), size_t(params.mapping.window.keyframes));
  const Copy at_end = copy;
  const edgevo::Run run = odometry.finish();
  for (const auto& [id, keyframe] : at_end.marginalised) expect_in(run, *keyframe);
  for (const WindowAdjusted::Active& a : *at_end.window.keyframes) expect_in(run, a.keyframe);
  for (const auto& event : cursor.read()) copy.apply(*event);
  EXPECT_TRUE(copy.window.keyframes->empty()) << "the map is closed";
}

// The live scale, e.g., knows the frame before the keyframe that mapping makes of it.
TEST(MapEvents, AFrameComesBeforeTheKeyframeMadeOfIt) {
  OdometryOptions options;
  options.map_log = std::make_shared<MapLog>();
  MapCursor cursor(options.map_log);
  Odometry odometry(sweep_camera(), {}, options);
  for (int k = 0; k < kFrames; ++k) odometry.process(sweep_frame(k));
  std::set<int> frames, segments;
  int keyframes = 0;
  for (const auto& event : cursor.read()) {
    if (const auto* e = std::get_if<FrameAnchored>(event.get())) frames.insert(e->frame.index);
    if (const auto* e = std::get_if<SegmentPlaced>(event.get())) segments.insert(e->segment);
    if (const auto* e = std::get_if<KeyframeAdded>(event.get())) {
      ++keyframes;
      EXPECT_TRUE(segments.count(e->segment));
      // The newest view of a bootstrap is announced with the poses that it found.
      EXPECT_TRUE(keyframes <= 5 || frames.count(e->frame_index)) << e->frame_index;
    }
  }
  EXPECT_GT(keyframes, 8);
  EXPECT_EQ(frames.size(), size_t(kFrames));
}

}  // namespace
}  // namespace edgevo
