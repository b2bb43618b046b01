// SPDX-License-Identifier: BSD-3-Clause
// Two maps of one path aligned by the places that both show, and joined; a map that a run extends.
#include <gmock/gmock.h>

#include <map>
#include <set>

#include "edgevo/core/angle.h"
#include "edgevo/kept_map/map_alignment.h"
#include "edgevo/kept_map/map_extension.h"
#include "edgevo/kept_map/map_join.h"
#include "edgevo/kept_map/write_map.h"
#include "made_map.h"

namespace edgevo {
namespace {

using ::testing::IsEmpty;
using ::testing::Lt;
using ::testing::SizeIs;

Pinhole camera() { return {200, 200, 160, 120, 320, 240}; }

// Poses along a bend, a metre apart.
SE3 on_path(int at) {
  const double angle = 0.02 * at;
  return {Eigen::Quaterniond(Eigen::AngleAxisd(angle, Eigen::Vector3d::UnitY())),
          Eigen::Vector3d(50 * (1 - std::cos(angle)), 0, 50 * std::sin(angle))};
}

// A map of keyframes at `first`, `first` + 1, ... of the path; from the world of the path by T_map_world.
KeptMap map_of_path(int first, int count, const Sim3& T_map_world = {}) {
  KeptMap map(MapHeader{camera(), "a camera", "path " + std::to_string(first)});
  map.is_finished = true;
  Random random{uint64_t(first)};
  for (int i = 0; i < count; ++i) {
    auto record = std::make_shared<KeyframeRecord>();
    record->frame_index = i;
    record->T_world_cam = on_path(first + i);
    for (int p = 0; p < 30; ++p) {
      EdgePoint point;
      point.px = {float(random.uniform(20, 300)), float(random.uniform(20, 220))};
      point.normal = {1, 0}, point.idepth = float(1 / random.uniform(10, 20)), point.idepth_sigma = 0.001F;
      record->points.push_back(point);
    }
    record->T_world_cam = T_map_world.apply(record->T_world_cam);
    multiply_depths(T_map_world.scale, record.get());
    auto view = std::make_shared<RememberedView>(test::made_view(camera(), 5, 3, &random));
    view->light = {100, 40};
    map.store.add({2 * i, 0, record, view, std::nullopt});
  }
  return map;
}

// That keyframes of both maps show one place, as their true poses have it, off by `off`.
StatedPlace place(const KeptMap& a, int in_a, const KeptMap& b, int in_b, const Sim3& T_a_b,
                  const Vector7d& off = Vector7d::Zero()) {
  const auto pose = [](const KeptMap& map, int i) {
    return Sim3{1, map.store.keyframes()[size_t(i)].record->T_world_cam};
  };
  StatedPlace p;
  p.place = size_t(in_a), p.query = size_t(in_b);
  p.T_place_query = Sim3::exp(off) * pose(a, in_a).inverse() * T_a_b * pose(b, in_b);
  p.covariance.diagonal() << Eigen::Vector3d::Constant(0.01), Eigen::Vector3d::Constant(1e-4), 1e-3;
  return p;
}

double error(const Sim3& a, const Sim3& b) { return (a * b.inverse()).log().norm(); }

class Alignment : public ::testing::Test {
 protected:
  const Sim3 T_a_b_{2.5,
                    SE3(Eigen::Quaterniond(Eigen::AngleAxisd(0.7, Eigen::Vector3d(0.2, 1, 0).normalized())),
                        Eigen::Vector3d(3, -1, 8))};
  KeptMap a_ = map_of_path(0, 40), b_ = map_of_path(25, 40, T_a_b_.inverse());

  std::vector<StatedPlace> places(int count) const {
    std::vector<StatedPlace> found;
    for (int i = 0; i < count; ++i) found.push_back(place(a_, 25 + i, b_, i, T_a_b_));
    return found;
  }
  // Another keyframe of the first map looks like the one that the place is.
  StatedPlace mistaken(int in_a, int in_b) const {
    StatedPlace p = place(a_, 25 + in_b, b_, in_b, T_a_b_);
    p.place = size_t(in_a);
    return p;
  }
};

TEST_F(Alignment, FollowsThePlaces) {
  const auto found = align_maps(a_, b_, places(12));
  ASSERT_TRUE(found);
  EXPECT_THAT(found->places, SizeIs(12));
  ASSERT_THAT(found->T_a_b, SizeIs(40));
  for (const Sim3& T : found->T_a_b) EXPECT_LT(error(T, T_a_b_), 0.01);
}

// A third of them lie elsewhere, and agree with each other.
TEST_F(Alignment, OutvotesPlacesThatLookAlike) {
  std::vector<StatedPlace> all = places(12);
  for (int i = 0; i < 6; ++i) all.push_back(mistaken(i, i));
  Vector7d off = Vector7d::Zero();
  off.head<3>() << 20, 0, 30;
  all.push_back(place(a_, 30, b_, 5, T_a_b_, off));
  const auto found = align_maps(a_, b_, all);
  ASSERT_TRUE(found);
  EXPECT_THAT(found->places, SizeIs(12));
  for (const Sim3& T : found->T_a_b) EXPECT_LT(error(T, T_a_b_), 0.01);
}

TEST_F(Alignment, NeedsThreePlacesThatAgree) {
  EXPECT_FALSE(align_maps(a_, b_, {}));
  EXPECT_FALSE(align_maps(a_, b_, places(2)));
  std::vector<StatedPlace> one(5, places(1).front());  // one keyframe is one place
  EXPECT_FALSE(align_maps(a_, b_, one));
  std::vector<StatedPlace> apart = places(2);
  apart.push_back(mistaken(3, 3));
  EXPECT_FALSE(align_maps(a_, b_, apart));
}

// Depths that err alike are outweighed by what both maps say of their metres, as far as that is sure.
TEST_F(Alignment, MetresOfBothMapsCount) {
  b_ = map_of_path(25, 40);
  Vector7d off = Vector7d::Zero();
  off[6] = 0.03;
  std::vector<StatedPlace> all;
  for (int i = 0; i < 12; ++i) all.push_back(place(a_, 25 + i, b_, i, Sim3(), off));
  const auto scale = [&] { return align_maps(a_, b_, all)->T_a_b.front().scale; };
  EXPECT_GT(scale(), 1.01);
  a_.scale_source = b_.scale_source = "gps";
  a_.scale_sigma = b_.scale_sigma = 1e-3;
  EXPECT_NEAR(scale(), 1, 0.003);
}

// The second path has drifted: it is bent to the first, which stays.
TEST_F(Alignment, BendsTheSecondMap) {
  b_ = map_of_path(0, 40);
  KeptMap bent(b_.header);
  for (StoredKeyframe k : b_.store.keyframes()) {
    auto record = std::make_shared<KeyframeRecord>(*k.record);
    record->T_world_cam =
        SE3(record->T_world_cam.rotation(),
            record->T_world_cam.translation() + Eigen::Vector3d(0, 0.01 * double(bent.store.size()), 0));
    k.record = record;
    bent.store.add(k);
  }
  std::vector<StatedPlace> all;
  for (int i : {0, 1, 2, 3, 36, 37, 38, 39}) all.push_back(place(a_, i, b_, i, Sim3()));
  const auto found = align_maps(a_, bent, all);
  ASSERT_TRUE(found);
  for (int i : {0, 20, 39}) {
    const SE3 there = found->T_a_b[size_t(i)].apply(bent.store.keyframes()[size_t(i)].record->T_world_cam);
    EXPECT_LT((there.translation() - on_path(i).translation()).norm(), 0.1) << i;
  }
}

TEST_F(Alignment, JoinedMapsAreInTheFrameAndUnitOfTheFirst) {
  Constraint own;
  own.from = NodeId::keyframe(2), own.to = NodeId::keyframe(60);
  own.T_from_to = {1, b_.store.T_a_b(1, 30)}, own.kind = ConstraintKind::kPlace;
  b_.constraints.push_back(own);
  const auto found = align_maps(a_, b_, places(12));
  ASSERT_TRUE(found);
  const KeptMap joined = join_maps(a_, b_, *found);
  test::TempFolder temp;
  write_map(joined, temp / "joined.db");
  const KeptMap read = read_map(temp / "joined.db");
  EXPECT_TRUE(read.is_finished);
  EXPECT_THAT(read.warnings, IsEmpty());
  EXPECT_EQ(read.header.source, "path 0 + path 25");
  ASSERT_EQ(read.store.size(), 80U);
  std::set<int> ids;
  for (const StoredKeyframe& k : read.store.keyframes()) ids.insert(k.id);
  EXPECT_THAT(ids, SizeIs(80));
  for (int i = 0; i < 40; ++i) {
    const StoredKeyframe& k = read.store.keyframes()[size_t(40 + i)];
    EXPECT_EQ(k.record->segment, 1);
    EXPECT_EQ(k.epoch, 1);
    EXPECT_LT((k.record->T_world_cam.translation() - on_path(25 + i).translation()).norm(), 0.05);
    for (const EdgePoint& p : k.record->points) EXPECT_THAT(1 / p.idepth, Lt(20.1));
  }
  ASSERT_THAT(read.constraints, SizeIs(13));
  for (const Constraint& c : read.constraints) {
    const size_t from = size_t(std::distance(ids.begin(), ids.find(c.from.number()))),
                 to = size_t(std::distance(ids.begin(), ids.find(c.to.number())));
    EXPECT_NEAR(c.T_from_to.scale, 1, 0.01);
    EXPECT_LT((c.T_from_to.rigid.translation() - read.store.T_a_b(from, to).translation()).norm(), 0.05);
  }
}

// ---- a map that grows ----

class Extension : public ::testing::Test {
 protected:
  // The keyframes of a run, found in the map.
  static std::vector<Constraint> found(const KeptMap& run) {
    Constraint c;
    c.from = NodeId::keyframe(2), c.to = NodeId::keyframe(run.store.keyframes().front().id);
    c.kind = ConstraintKind::kPlace;
    return {c};
  }
  static void set_light(float mean, KeptMap* map) {
    PlaceStore there(map->store.pinhole());
    for (StoredKeyframe k : map->store.keyframes()) {
      auto view = std::make_shared<RememberedView>(*k.view);
      view->light.mean = mean;
      k.view = view;
      there.add(k);
    }
    map->store = there;
  }
  KeptMap map_ = map_of_path(0, 30);
};

TEST_F(Extension, AddsWhatTheMapDoesNotShow) {
  const KeptMap run = map_of_path(20, 40);  // 10 of them within the map
  const size_t added = extend_map(run, found(run), &map_);
  EXPECT_GE(added, 22U);
  EXPECT_LE(added, 32U);
  EXPECT_EQ(map_.store.size(), 30 + added);
  EXPECT_EQ(map_.store.keyframes().back().record->segment, 1);
  EXPECT_EQ(extend_map(run, found(run), &map_), 0U);  // it has them now
}

TEST_F(Extension, KeepsThreeRecordsOfAPlaceInDifferentLight) {
  std::vector<size_t> added;
  for (const float mean : {101.F, 60.F, 150.F, 220.F}) {
    KeptMap run = map_of_path(0, 30);
    set_light(mean, &run);
    added.push_back(extend_map(run, found(run), &map_));
  }
  EXPECT_THAT(added, ::testing::ElementsAre(0, 30, 30, 0));
  EXPECT_THAT(map_.constraints, SizeIs(2));
}

TEST_F(Extension, AddsNothingOfWhatWasNotPlaced) {
  const KeptMap run = map_of_path(20, 40);
  EXPECT_EQ(extend_map(run, {}, &map_), 0U);
}

}  // namespace
}  // namespace edgevo
