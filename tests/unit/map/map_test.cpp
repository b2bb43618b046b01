// SPDX-License-Identifier: BSD-3-Clause
// The owner of the keyframes: what it announces, what it drops, and how it moves.
#include "edgevo/map/map.h"

#include <gtest/gtest.h>

#include <stdexcept>

#include "support/sweep_scene.h"

namespace edgevo {
namespace {

using test::Sweep;

std::shared_ptr<const FramePyramid> same_images(const Keyframe& k) { return k.pyramid; }

Keyframe keyframe(int id) {
  Random random(uint64_t(id) + 1);
  Keyframe k = test::true_keyframe(id, 4 * id, 0, &random);
  k.immature.resize(20);
  for (int i = 0; i < 3; ++i) {
    MapPoint p;
    p.px = k.immature[size_t(i)].px;
    p.normal = k.immature[size_t(i)].normal;
    p.idepth = 0.1, p.idepth_sigma = 0.01;
    Observation o;
    o.keyframe_id = id + 1;
    o.match.px = p.px;
    o.match.normal = p.normal;
    p.observations.push_back(o);
    k.points.push_back(p);
  }
  return k;
}

// Keyframes 0 to 4, of which 0 and 1 are marginalised.
class MapOfFive : public ::testing::Test {
 protected:
  MapOfFive() {
    for (int id = 0; id < 3; ++id) map_.add(keyframe(id));
    map_.begin_segment(6);
    for (int id = 3; id < 5; ++id) map_.add(keyframe(id));
    map_.marginalise_oldest({{1, SE3(), Matrix6d::Identity()}});
    map_.marginalise_oldest({});
  }

  // Keyframe 0 is at half its distance from the newest one.
  MapMoved half_the_way() const {
    MapMoved moved;
    moved.segment = 6;
    moved.keyframes.resize(1);
    const SE3 T = map_.marginalised()[0].T_cam_world * map_.active().back().T_cam_world.inverse();
    moved.keyframes[0].T_cam_newest = SE3(T.rotation(), 0.5 * T.translation());
    moved.keyframes[0].scale_ratio = 0.5;
    return moved;
  }
  // All points are seen a pixel further to the right.
  MapMoved other_lens() const {
    MapMoved moved;
    moved.segment = 6;
    moved.prior.emplace();
    moved.lens = LensChange{{}, {0.03, 0}};
    for (const std::deque<Keyframe>* keyframes : {&map_.marginalised(), &map_.active()})
      for (const Keyframe& k : *keyframes) {
        KeyframeMove m;
        m.id = k.id;
        m.T_cam_newest = k.T_cam_world * map_.active().back().T_cam_world.inverse();
        for (const MapPoint& p : k.points) m.points.push_back({p.px + Eigen::Vector2d(1, 0), 0.3});
        moved.keyframes.push_back(m);
      }
    return moved;
  }
  template <class Event>
  std::vector<Event> events() {
    std::vector<Event> found;
    for (const auto& event : cursor_.read())
      if (const auto* e = std::get_if<Event>(event.get())) found.push_back(*e);
    return found;
  }
  void expect_refused(const MapMoved& moved) {
    const SE3 before = map_.marginalised()[0].T_cam_world;
    (void)cursor_.read();
    EXPECT_THROW(map_.move(moved, same_images), std::invalid_argument);
    EXPECT_EQ(map_.marginalised()[0].T_cam_world.matrix(), before.matrix());
    EXPECT_EQ(map_.moves(), 0);
    EXPECT_TRUE(cursor_.read().empty());
  }

  std::shared_ptr<MapLog> log_ = std::make_shared<MapLog>();
  MapCursor cursor_{log_};
  Map map_{Sweep::pinhole(), log_};
};

TEST_F(MapOfFive, AnnouncesEachKeyframeOnce) {
  int expected = 0;
  for (const KeyframeAdded& e : events<KeyframeAdded>()) {
    EXPECT_EQ(e.id, expected++);
    EXPECT_EQ(e.frame_index, 4 * e.id);
    EXPECT_EQ(e.segment, 6);
  }
  EXPECT_EQ(expected, 5);
}

TEST_F(MapOfFive, AMarginalisedKeyframeKeepsItsMatchesAndImages) {
  ASSERT_EQ(map_.marginalised().size(), 2u);
  const Keyframe& k = map_.marginalised()[0];
  EXPECT_TRUE(k.pyramid);
  EXPECT_EQ(k.points.size(), 3u);
  EXPECT_TRUE(k.immature.empty());
  const auto left = events<KeyframeMarginalised>();
  ASSERT_EQ(left.size(), 2u);
  EXPECT_EQ(left[0].keyframe->points.size(), 3u);
  EXPECT_EQ(left[0].neighbours.at(0).id, 1);
  EXPECT_EQ(map_.stored().at(0).keyframe, left[0].keyframe) << "shared";
  EXPECT_EQ(map_.stored().at(0).segment, 6);
}

TEST_F(MapOfFive, EvictsImagesAndMatchesButKeepsTheRecords) {
  map_.evict_images(1);
  EXPECT_FALSE(map_.marginalised()[0].pyramid);
  EXPECT_TRUE(map_.marginalised()[1].pyramid);
  map_.evict_matches(1);
  ASSERT_EQ(map_.marginalised().size(), 1u);
  EXPECT_EQ(map_.marginalised()[0].id, 1);
  EXPECT_EQ(map_.stored().size(), 2u);
  map_.evict_matches(5);
  EXPECT_EQ(map_.marginalised().size(), 1u);
}

TEST_F(MapOfFive, TheWindowIsAnnouncedAsItIs) {
  map_.announce_window();
  const WindowAdjusted window = events<WindowAdjusted>().back();
  ASSERT_EQ(window.keyframes->size(), 3u);
  EXPECT_EQ(window.keyframes->front().id, 2);
  EXPECT_EQ(window.moves, 0);
}

TEST_F(MapOfFive, ASegmentEndsWithAnEmptyWindow) {
  while (!map_.active().empty()) map_.marginalise_oldest({});
  map_.end_segment();
  EXPECT_TRUE(events<WindowAdjusted>().back().keyframes->empty());
  EXPECT_TRUE(map_.marginalised().empty());
  EXPECT_EQ(map_.stored().size(), 5u);
  EXPECT_EQ(map_.segment(), -1);
}

TEST_F(MapOfFive, ARefusedMapIsNeverAnnounced) {
  while (!map_.active().empty()) map_.marginalise_oldest({});
  map_.end_segment();
  (void)cursor_.read();
  map_.add(keyframe(5));
  map_.discard();
  EXPECT_TRUE(map_.active().empty());
  EXPECT_TRUE(cursor_.read().empty());
}

// Pixels stay, and depths change with the unit of length.
TEST_F(MapOfFive, APastKeyframeMovesWithoutALens) {
  const Keyframe before = map_.marginalised()[0], untouched = map_.marginalised()[1];
  const auto record = map_.stored().at(0).keyframe;
  const MapMoved moved = map_.move(half_the_way(), same_images);
  EXPECT_EQ(map_.moves(), 1);
  EXPECT_EQ(moved.T_newest_map.matrix(), map_.active().back().T_cam_world.matrix());
  const Keyframe& k = map_.marginalised()[0];
  EXPECT_EQ(k.T_cam_world.matrix(), moved.T_cam_map(moved.keyframes[0]).matrix());
  EXPECT_DOUBLE_EQ(k.points[0].idepth, 0.2);
  EXPECT_DOUBLE_EQ(k.points[0].idepth_sigma, 0.02);
  EXPECT_EQ(k.points[0].px, before.points[0].px);
  EXPECT_EQ(k.points[0].observations[0].match.px, before.points[0].observations[0].match.px);
  EXPECT_TRUE(k.pyramid) << "its image is as good as before";
  EXPECT_EQ(map_.marginalised()[1].T_cam_world.matrix(), untouched.T_cam_world.matrix());
  const auto& stored = map_.stored().at(0).keyframe;
  EXPECT_EQ(stored->T_world_cam.matrix(), k.T_cam_world.inverse().matrix());
  EXPECT_FLOAT_EQ(stored->points[0].idepth, 0.2f);
  EXPECT_FLOAT_EQ(record->points[0].idepth, 0.1f) << "what was announced never changes";
  const auto announced = events<MapMoved>();
  ASSERT_EQ(announced.size(), 1u);
  EXPECT_EQ(announced[0].T_newest_map.matrix(), moved.T_newest_map.matrix());
}

// A focal length that turns out shorter takes points of the window out of the image, where no cell holds
// them.
TEST_F(MapOfFive, PointsThatALensTakesOutOfTheImageAreDropped) {
  MapMoved moved = other_lens();
  const auto take_out = [&](KeyframeMove* m) { m->points[1].px = {-3, 20}; };
  take_out(&moved.keyframes.front()), take_out(&moved.keyframes.back());
  map_.move(moved, same_images);
  EXPECT_EQ(map_.active().back().points.size(), 2u);
  EXPECT_EQ(map_.active().front().points.size(), 3u);
  EXPECT_EQ(map_.marginalised().front().points.size(), 3u) << "as many as its record has";
  map_.move(half_the_way(), same_images);
}

// Also of a keyframe whose matches are gone.
TEST_F(MapOfFive, AKeyframeOfTheDistantPastMovesByItsRecord) {
  const MapMoved moved = half_the_way();
  map_.evict_matches(0);
  map_.move(moved, same_images);
  EXPECT_FLOAT_EQ(map_.stored().at(0).keyframe->points[0].idepth, 0.2f);
}

TEST_F(MapOfFive, ALensMovesWhatIsMeasuredInTheImages) {
  MapMoved moved = other_lens();
  int rebuilt = 0;
  const Eigen::Vector2d match = map_.marginalised()[0].points[0].observations[0].match.px;
  map_.move(moved, [&](const Keyframe& k) {
    ++rebuilt;
    return k.pyramid;
  });
  EXPECT_EQ(rebuilt, 3) << "the images of active keyframes";
  for (const Keyframe& k : map_.marginalised()) EXPECT_FALSE(k.pyramid);
  EXPECT_EQ(map_.marginalised()[0].points[0].idepth, 0.3);
  EXPECT_NE(map_.marginalised()[0].points[0].observations[0].match.px, match);
  moved.keyframes.erase(moved.keyframes.begin() + 3);
  EXPECT_THROW(map_.move(moved, same_images), std::invalid_argument) << "an image would not be corrected";
}

TEST_F(MapOfFive, MovesThatMakeNoSenseAreRefused) {
  MapMoved window = half_the_way(), unknown = window, twice = window, past = window, points = window;
  window.keyframes[0].id = 3;
  expect_refused(window);
  unknown.keyframes[0].id = 17;
  expect_refused(unknown);
  twice.keyframes.push_back(twice.keyframes[0]);
  expect_refused(twice);
  past.segment = 5;
  expect_refused(past);
  points.keyframes[0].points.resize(2);
  expect_refused(points);
}

TEST_F(MapOfFive, TheNewestKeyframeStaysInItsPlace) {
  MapMoved newest = half_the_way();
  newest.prior.emplace();
  newest.keyframes[0].id = 4;
  expect_refused(newest);
  newest.keyframes[0].T_cam_newest = SE3();
  map_.move(newest, same_images);
  EXPECT_DOUBLE_EQ(map_.active().back().points[0].idepth, 0.2) << "lengths near it may change";
}

TEST_F(MapOfFive, AKeyframeOfTheWindowMovesWithAPrior) {
  MapMoved moved = half_the_way();
  moved.keyframes[0].id = 3;
  moved.prior.emplace();
  map_.move(moved, same_images);
  EXPECT_DOUBLE_EQ(map_.active()[1].points[0].idepth, 0.2);
}

}  // namespace
}  // namespace edgevo
