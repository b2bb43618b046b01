// SPDX-License-Identifier: BSD-3-Clause
// A rendered run whose past is moved by another producer than self-calibration, without a lens: everything
// that belongs to the moved keyframes follows, and nothing else changes.
#include <gtest/gtest.h>

#include <map>
#include <memory>
#include <stdexcept>
#include <utility>

#include "edgevo/map/map.h"
#include "edgevo/map/run_builder.h"
#include "unit/odometry/rendered_runs.h"

namespace edgevo {
namespace {

using test::sweep_camera;
using test::sweep_frame;

constexpr int kDriveFrames = 110;
constexpr size_t kMarginalisedAtMove = 10;

// New over old length of a keyframe; the first one stays where it is.
double ratio_of(int id) { return id == 0 ? 1 : 0.8 + 0.05 * (id % 9); }

// A made-up similarity for each marginalised keyframe but the first.
MapMoved made_up(const Map& map) {
  MapMoved moved;
  moved.segment = map.segment();
  Random random(8);
  for (const auto& [id, stored] : map.stored()) {
    if (id == 0) continue;
    Vector6d xi;
    for (int i = 0; i < 6; ++i) xi[i] = 0.05 * random.normal();
    const SE3 T = stored.keyframe->T_world_cam.inverse() * map.active().back().T_cam_world.inverse();
    KeyframeMove m;
    m.id = id;
    m.scale_ratio = ratio_of(id);
    m.T_cam_newest = SE3::exp(xi) * SE3(T.rotation(), m.scale_ratio * T.translation());
    moved.keyframes.push_back(m);
  }
  return moved;
}

// A run with all that it leaves.
struct Followed {
  std::vector<FrameRecord> live;
  std::vector<std::shared_ptr<const MapEvent>> events;
  edgevo::Run run;

  template <class Event>
  std::vector<Event> all() const {
    std::vector<Event> found;
    for (const auto& event : events)
      if (const auto* e = std::get_if<Event>(event.get())) found.push_back(*e);
    return found;
  }
};

Followed follow(bool is_moved) {
  OdometryParams params;
  params.camera.refine = "none";
  params.mapping.window.keyframes = 7;
  params.keyframe.max_frames = 3;
  params.edge_map.max_relative_sigma = 0.05;
  params.edge_map.mode = "keyframes";  // lines of later keyframes do not depend on those of earlier ones
  OdometryOptions options;
  options.map_log = std::make_shared<MapLog>();
  options.move_map = [is_moved, done = false](const Map& map) mutable -> std::optional<MapMoved> {
    if (!is_moved || done || map.stored().size() < kMarginalisedAtMove) return std::nullopt;
    done = true;
    return made_up(map);
  };
  Followed f;
  MapCursor cursor(options.map_log);
  Odometry odometry(sweep_camera(), params, options);
  for (int k = 0; k < kDriveFrames; ++k) f.live.push_back(odometry.process(sweep_frame(k)));
  f.run = odometry.finish();
  f.events = cursor.read();
  return f;
}

class MovedPast : public ::testing::Test {
 protected:
  static const Followed& plain() {
    static const Followed f = follow(false);
    return f;
  }
  static const Followed& moved() {
    static const Followed f = follow(true);
    return f;
  }
  static const MapMoved& move() {
    static const MapMoved m = moved().all<MapMoved>().at(0);
    return m;
  }
  // Id of a keyframe of the run.
  static int id_of(size_t keyframe) {
    std::map<int, int> id_of_frame;
    for (const auto& e : moved().all<KeyframeAdded>()) id_of_frame[e.frame_index] = e.id;
    return id_of_frame.at(moved().run.keyframes[keyframe].frame_index);
  }
  static bool is_moved(int reference_keyframe) { return move().find(id_of(size_t(reference_keyframe))); }
};

template <class A>
void expect_equal(const std::optional<A>& a, const std::optional<A>& b) {
  ASSERT_EQ(a.has_value(), b.has_value());
  EXPECT_EQ(a.value_or(A()).matrix(), b.value_or(A()).matrix());
}

void expect_same(const std::vector<EdgePoint>& a, const std::vector<EdgePoint>& b) {
  ASSERT_EQ(a.size(), b.size());
  for (size_t i = 0; i < a.size(); ++i) {
    EXPECT_EQ(a[i].px, b[i].px);
    EXPECT_EQ(a[i].idepth, b[i].idepth);
    EXPECT_EQ(a[i].idepth_sigma, b[i].idepth_sigma);
  }
}

TEST_F(MovedPast, TheRunHasMovedOnceInItsMiddle) {
  EXPECT_EQ(plain().all<MapMoved>().size(), 0u);
  EXPECT_EQ(moved().all<MapMoved>().size(), 1u);
  EXPECT_GE(move().keyframes.size(), kMarginalisedAtMove - 1);
  EXPECT_GT(moved().run.keyframes.size(), kMarginalisedAtMove + 8);
}

TEST_F(MovedPast, LivePosesDoNotChangeByABit) {
  for (size_t k = 0; k < size_t(kDriveFrames); ++k) {
    expect_equal(plain().live[k].T_world_cam_live, moved().live[k].T_world_cam_live);
    EXPECT_EQ(plain().live[k].covariance, moved().live[k].covariance);
    EXPECT_EQ(plain().live[k].note, moved().live[k].note);
    expect_equal(plain().run.frames[k].T_world_cam_live, moved().run.frames[k].T_world_cam_live);
  }
}

TEST_F(MovedPast, LaterKeyframesDoNotChangeByABit) {
  const auto a = plain().all<KeyframeMarginalised>(), b = moved().all<KeyframeMarginalised>();
  ASSERT_EQ(a.size(), b.size());
  for (size_t i = 0; i < a.size(); ++i) {
    EXPECT_EQ(a[i].id, b[i].id);
    EXPECT_EQ(a[i].keyframe->T_world_cam.matrix(), b[i].keyframe->T_world_cam.matrix());
    expect_same(a[i].keyframe->points, b[i].keyframe->points);
  }
}

TEST_F(MovedPast, KeyframesAndTheirPointsFollow) {
  for (size_t i = 0; i < moved().run.keyframes.size(); ++i) {
    const KeyframeRecord &a = plain().run.keyframes[i], &b = moved().run.keyframes[i];
    const KeyframeMove* m = move().find(id_of(i));
    const SE3 expected = m ? move().T_cam_map(*m).inverse() : a.T_world_cam;
    EXPECT_LT((b.T_world_cam.inverse() * expected).log().norm(), 1e-12) << i;
    ASSERT_EQ(a.points.size(), b.points.size());
    for (size_t p = 0; p < a.points.size(); ++p) {
      const float ratio = m ? float(m->scale_ratio) : 1;
      EXPECT_FLOAT_EQ(b.points[p].idepth, a.points[p].idepth / ratio);
      EXPECT_FLOAT_EQ(b.points[p].idepth_sigma, a.points[p].idepth_sigma / ratio);
    }
  }
}

TEST_F(MovedPast, LinesOfMovedKeyframesFollow) {
  size_t lines = 0;
  for (size_t i = 0; i < moved().run.keyframes.size(); ++i) {
    const KeyframeMove* m = move().find(id_of(i));
    if (!m) continue;
    const auto &a = plain().run.keyframes[i].lines, &b = moved().run.keyframes[i].lines;
    ASSERT_EQ(a.size(), b.size()) << i;
    for (size_t l = 0; l < a.size(); ++l, ++lines) {
      ASSERT_EQ(a[l].vertices.size(), b[l].vertices.size());
      for (size_t v = 0; v < a[l].vertices.size(); ++v) {
        EXPECT_EQ(a[l].vertices[v].px, b[l].vertices[v].px);
        EXPECT_FLOAT_EQ(b[l].vertices[v].idepth, a[l].vertices[v].idepth / float(m->scale_ratio));
      }
    }
  }
  EXPECT_GT(lines, 20u);
}

TEST_F(MovedPast, FramesFollowTheirKeyframesAndLaterOnesStay) {
  int followed = 0, stayed = 0;
  for (size_t k = 0; k < size_t(kDriveFrames); ++k) {
    const FrameRecord &a = plain().run.frames[k], &b = moved().run.frames[k];
    ASSERT_EQ(a.T_world_cam.has_value(), b.T_world_cam.has_value());
    ASSERT_EQ(a.reference_keyframe, b.reference_keyframe);
    if (!a.T_world_cam) continue;
    const size_t reference = size_t(a.reference_keyframe);
    const bool follows = is_moved(a.reference_keyframe);
    ++(follows ? followed : stayed);
    const double ratio = follows ? ratio_of(id_of(reference)) : 1;
    const SE3 T_ref_cam = plain().run.keyframes[reference].T_world_cam.inverse() * *a.T_world_cam;
    const SE3 expected = moved().run.keyframes[reference].T_world_cam *
                         SE3(T_ref_cam.rotation(), ratio * T_ref_cam.translation());
    EXPECT_LT((b.T_world_cam->inverse() * expected).log().norm(), 1e-9) << k;
    EXPECT_NEAR(b.covariance(0, 0), ratio * ratio * a.covariance(0, 0), 1e-9 * a.covariance(0, 0)) << k;
    EXPECT_NEAR(b.covariance(0, 4), ratio * a.covariance(0, 4), 1e-9 * std::abs(a.covariance(0, 4))) << k;
    EXPECT_EQ(b.covariance(4, 4), a.covariance(4, 4)) << k;
  }
  EXPECT_GT(followed, 20);
  EXPECT_GT(stayed, 20);
}

TEST_F(MovedPast, AnotherReaderOfTheEventsBuildsTheSameRun) {
  RunBuilder builder(sweep_camera().pinhole());
  for (const auto& event : moved().events) builder.apply(*event);
  const edgevo::Run run = builder.finish();
  const edgevo::Run& expected = moved().run;
  ASSERT_EQ(run.frames.size(), expected.frames.size());
  for (size_t k = 0; k < run.frames.size(); ++k) {
    const FrameRecord &a = run.frames[k], &b = expected.frames[k];
    expect_equal(a.T_world_cam, b.T_world_cam);
    expect_equal(a.T_world_cam_live, b.T_world_cam_live);
    EXPECT_EQ(a.covariance, b.covariance);
    EXPECT_EQ(a.state, b.state);
    EXPECT_EQ(a.stage_ms, b.stage_ms);
    EXPECT_EQ(a.note, b.note);
    EXPECT_EQ(a.keyframe_reason, b.keyframe_reason);
  }
  ASSERT_EQ(run.keyframes.size(), expected.keyframes.size());
  for (size_t i = 0; i < run.keyframes.size(); ++i) {
    EXPECT_EQ(run.keyframes[i].T_world_cam.matrix(), expected.keyframes[i].T_world_cam.matrix());
    expect_same(run.keyframes[i].points, expected.keyframes[i].points);
    ASSERT_EQ(run.keyframes[i].lines.size(), expected.keyframes[i].lines.size());
    for (size_t l = 0; l < run.keyframes[i].lines.size(); ++l) {
      const auto &a = run.keyframes[i].lines[l].vertices, &b = expected.keyframes[i].lines[l].vertices;
      ASSERT_EQ(a.size(), b.size());
      for (size_t v = 0; v < a.size(); ++v) {
        EXPECT_EQ(a[v].px, b[v].px);
        EXPECT_EQ(a[v].idepth, b[v].idepth);
      }
    }
  }
  EXPECT_EQ(run.camera.given.keyframes, expected.camera.given.keyframes);
}

// It costs the program an exception and a keyframe, but not the run.
TEST(RefusedMove, TheRunGoesOn) {
  for (const bool is_lens : {false, true}) {
    OdometryOptions options;
    options.move_map = [is_lens, done = false](const Map& map) mutable -> std::optional<MapMoved> {
      if (std::exchange(done, true)) return std::nullopt;
      MapMoved moved;
      moved.segment = is_lens ? map.segment() : map.segment() + 1;
      if (is_lens) moved.lens.emplace();
      return moved;
    };
    Odometry odometry(sweep_camera(), {}, options);
    constexpr int kSome = 60;
    int refused = 0;
    for (int k = 0; k < kSome; ++k) {
      try {
        (void)odometry.process(sweep_frame(k));
      } catch (const std::invalid_argument&) {
        ++refused;
      }
    }
    EXPECT_EQ(refused, 1);
    const auto run = odometry.finish();
    ASSERT_EQ(run.frames.size(), size_t(kSome));
    EXPECT_TRUE(run.frames.back().T_world_cam);
  }
}

}  // namespace
}  // namespace edgevo
