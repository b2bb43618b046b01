// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/places/place_memory.h"

#include <gmock/gmock.h>

#include <map>
#include <utility>

#include "rendered_view.h"

namespace edgevo {
namespace {

using test::street;
using ::testing::IsEmpty;
using ::testing::SizeIs;

// A frame of the street; each is rendered once.
struct StreetFrame {
  std::shared_ptr<const FramePyramid> pyramid;
  std::vector<EdgePoint> points;  // in metres
};
const StreetFrame& street_frame(int frame) {
  static std::map<int, StreetFrame> known;
  StreetFrame& f = known[frame];
  if (!f.pyramid) f.pyramid = street().pyramid(frame), f.points = street().edge_points(*f.pyramid, frame);
  return f;
}

// Keyframes of a rendered street as a run announces them, in maps with units of their own.
class StreetRun {
 public:
  StreetRun() : log_(std::make_shared<MapLog>()), events_(log_) {}

  PlaceMemory memory(std::shared_ptr<const PlaceStore> kept = nullptr) const {
    return {Rectification(street().pinhole()), log_, {}, std::move(kept)};
  }

  void begin_segment(double unit) {
    unit_ = unit;
    append(SegmentPlaced{++segment_, {}});
  }
  // A keyframe at a frame of the scene; the map places it `off` metres to the right of where it is.
  void add(int frame, double off = 0) {
    append(KeyframeAdded{next_, next_, segment_});
    append(KeyframeMarginalised{next_, record_of(frame, off), {}, street_frame(frame).pyramid});
    frames_.push_back(frame);
    ++next_;
  }
  // A keyframe that stays in the window.
  void begin(int frame) {
    append(KeyframeAdded{next_, next_, segment_});
    window_.push_back({next_, *record_of(frame, 0), street_frame(frame).pyramid});
    append(WindowAdjusted{0, std::make_shared<const std::vector<WindowAdjusted::Active>>(window_)});
    frames_.push_back(frame);
    ++next_;
  }
  // The camera is corrected: the images of keyframes in the window are rectified anew.
  void correct_camera(int shown_by) {
    for (WindowAdjusted::Active& k : window_) k.pyramid = street().pyramid(shown_by);
    MapMoved moved;
    moved.segment = segment_;
    append(moved);
    append(WindowAdjusted{1, std::make_shared<const std::vector<WindowAdjusted::Active>>(window_)});
  }
  // The window's keyframes leave it, in their order.
  void close() {
    for (const WindowAdjusted::Active& k : std::exchange(window_, {}))
      append(KeyframeMarginalised{k.id, std::make_shared<const KeyframeRecord>(k.keyframe), {}, k.pyramid});
  }

  std::shared_ptr<const KeyframeRecord> record_of(int frame, double off) const {
    const StreetFrame& seen = street_frame(frame);
    auto record = std::make_shared<KeyframeRecord>();
    record->frame_index = next_;
    record->segment = segment_;
    SE3 pose = street().T_world_cam(frame);
    pose = SE3(pose.rotation(), unit_ * (pose.translation() + Eigen::Vector3d(off, 0, 0)));
    record->T_world_cam = pose;
    record->points = seen.points;
    for (EdgePoint& p : record->points) p.idepth /= float(unit_), p.idepth_sigma /= float(unit_);
    return record;
  }

  // The constraints that were stated since the last call.
  std::vector<Constraint> follow(PlaceMemory* memory) {
    std::vector<Constraint> stated;
    const auto note = [&](const MapEvent& event) {
      if (const auto* added = std::get_if<ConstraintAdded>(&event)) stated.push_back(added->constraint);
      withdrawn_ += std::holds_alternative<ConstraintWithdrawn>(event);
    };
    for (const auto& event : events_.read()) memory->apply(*event), note(*event);
    for (const auto& event : events_.read()) note(*event);
    return stated;
  }
  // Number of those withdrawn.
  int withdrawn() const { return withdrawn_; }
  int frame_of(NodeId keyframe) const { return frames_[size_t(keyframe.number())]; }
  SE3 truth(NodeId from, NodeId to) const {
    return street().T_world_cam(frame_of(from)).inverse() * street().T_world_cam(frame_of(to));
  }
  SE3 truth(NodeId keyframe) const { return street().T_world_cam(frame_of(keyframe)); }

 private:
  void append(MapEvent event) { log_->append(std::move(event)); }

  std::shared_ptr<MapLog> log_;
  MapCursor events_;
  std::vector<int> frames_;  // by keyframe
  std::vector<WindowAdjusted::Active> window_;
  int segment_ = -1, next_ = 0, withdrawn_ = 0;
  double unit_ = 1;
};

TEST(PlaceMemory, StatesAPlaceThatIsSeenAgain) {
  StreetRun run;
  PlaceMemory memory = run.memory();
  run.begin_segment(1);
  for (int frame = 0; frame < 50; ++frame) run.add(frame);
  EXPECT_THAT(run.follow(&memory), IsEmpty());  // nothing so far
  for (int frame = 5; frame < 20; ++frame) run.add(frame, 0.1);
  const std::vector<Constraint> stated = run.follow(&memory);
  ASSERT_GE(stated.size(), 5U);
  for (const Constraint& c : stated) {
    EXPECT_EQ(c.kind, ConstraintKind::kPlace);
    EXPECT_LT(c.from.number(), c.to.number());
    const SE3 off = c.T_from_to.rigid * run.truth(c.from, c.to).inverse();
    EXPECT_LT(off.translation().norm(), 0.15) << run.frame_of(c.from) << " " << run.frame_of(c.to);
    EXPECT_NEAR(c.T_from_to.scale, 1, 0.03);
  }
  EXPECT_EQ(memory.counts().stated, int(stated.size()));
}

TEST(PlaceMemory, FindsTheUnitOfAnotherSegment) {
  StreetRun run;
  PlaceMemory memory = run.memory();
  run.begin_segment(1);
  for (int frame = 0; frame < 25; ++frame) run.add(frame);
  run.begin_segment(3);
  for (int frame = 3; frame < 18; ++frame) run.add(frame);
  const std::vector<Constraint> stated = run.follow(&memory);
  ASSERT_GE(stated.size(), 3U);
  for (const Constraint& c : stated) EXPECT_NEAR(3 * c.T_from_to.scale, 1, 0.05);
}

// The path has no such error in it: what the views show must be another place that looks alike.
TEST(PlaceMemory, DoesNotBelieveWhatThePathContradicts) {
  StreetRun run;
  PlaceMemory memory = run.memory();
  run.begin_segment(1);
  for (int frame = 0; frame < 50; ++frame) run.add(frame);
  for (int frame = 5; frame < 20; ++frame) run.add(frame, 60);
  EXPECT_THAT(run.follow(&memory), IsEmpty());
  EXPECT_GT(memory.counts().beyond_drift, 0);
}

// The map of a run through the beginning of the street, in metres.
std::shared_ptr<const PlaceStore> kept_street() {
  auto kept = std::make_shared<PlaceStore>(street().pinhole());
  StreetRun before;
  PlaceMemory memory = before.memory();
  memory.on_stored([&](const StoredKeyframe& k) { kept->add(k); });
  before.begin_segment(1);
  for (int frame = 0; frame < 25; ++frame) before.add(frame);
  before.follow(&memory);
  return kept;
}

TEST(PlaceMemory, PlacesARunInAKeptMap) {
  const double unit = 2;
  const std::shared_ptr<const PlaceStore> kept = kept_street();
  StreetRun run;
  PlaceMemory memory = run.memory(kept);
  std::vector<Constraint> found;
  memory.on_found([&](const Constraint& c) { found.push_back(c); });
  run.begin_segment(unit);
  for (int frame = 4; frame < 18; ++frame) run.add(frame);
  const std::vector<Constraint> stated = run.follow(&memory);
  ASSERT_GE(stated.size(), 3U);
  for (const Constraint& c : stated) {
    EXPECT_EQ(c.from, NodeId::world());
    EXPECT_NEAR(unit * c.T_from_to.scale, 1, 0.05);
    EXPECT_LT((c.T_from_to.rigid.translation() - run.truth(c.to).translation()).norm(), 0.15);
  }
  EXPECT_EQ(memory.counts().in_kept_map, int(stated.size()));
  // The same between the keyframes.
  ASSERT_EQ(found.size(), stated.size());
  for (size_t i = 0; i < found.size(); ++i) {
    EXPECT_EQ(found[i].to, stated[i].to);
    const Sim3 T_world_place{1, kept->keyframes()[size_t(found[i].from.number())].record->T_world_cam};
    EXPECT_LT((T_world_place * found[i].T_from_to * stated[i].T_from_to.inverse()).log().norm(), 1e-9);
  }
}

// Keyframes in the window are looked up there although the run was found; each until it says so outside of
// it.
TEST(PlaceMemory, LooksUpTheWindowAllAlong) {
  StreetRun run;
  PlaceMemory memory = run.memory(kept_street());
  memory.look_up_young(true);
  run.begin_segment(2);
  for (int frame = 4; frame < 8; ++frame) run.begin(frame);
  const size_t first = run.follow(&memory).size();
  EXPECT_GE(first, 3U);
  for (int frame = 8; frame < 14; ++frame) run.begin(frame);
  const size_t more = run.follow(&memory).size();
  EXPECT_GE(more, 4U);
  run.close();
  run.follow(&memory);
  memory.finish();
  run.follow(&memory);
  EXPECT_GE(run.withdrawn(), int(first + more) - 2);
}

// A doubt can be evaluated when the keyframes after it have been stored.
// A run is found before its first keyframes leave the window; once they have, what they say counts.
TEST(PlaceMemory, FindsAYoungSegmentByItsWindow) {
  StreetRun run;
  PlaceMemory memory = run.memory();
  run.begin_segment(1);
  for (int frame = 0; frame < 25; ++frame) run.add(frame);
  EXPECT_THAT(run.follow(&memory), IsEmpty());
  run.begin_segment(3);
  for (int frame = 5; frame < 9; ++frame) run.begin(frame);
  const std::vector<Constraint> young = run.follow(&memory);
  ASSERT_THAT(young, SizeIs(::testing::AllOf(::testing::Ge(3U), ::testing::Le(4U))));
  for (const Constraint& c : young) EXPECT_NEAR(3 * c.T_from_to.scale, 1, 0.05);
  EXPECT_EQ(memory.counts().stated, 0);  // it is withdrawn later
  for (int frame = 9; frame < 13; ++frame) run.begin(frame);
  EXPECT_THAT(run.follow(&memory), IsEmpty());  // found already
  run.close();
  for (int frame = 13; frame < 18; ++frame) run.add(frame);
  EXPECT_EQ(run.withdrawn(), 0);
  EXPECT_GE(run.follow(&memory).size(), 3U);
  EXPECT_EQ(run.withdrawn(), int(young.size()));
}

// Without keyframes after them.
TEST(PlaceMemory, LooksUpTheLastKeyframesAtTheEnd) {
  StreetRun run;
  PlaceMemory memory = run.memory();
  run.begin_segment(1);
  for (int frame = 0; frame < 25; ++frame) run.add(frame);
  run.begin_segment(3);
  for (int frame = 5; frame < 9; ++frame) run.add(frame);
  EXPECT_THAT(run.follow(&memory), IsEmpty());
  memory.finish();
  EXPECT_GE(run.follow(&memory).size(), 3U);
}

TEST(PlaceMemory, AnEpochThatIsAnnouncedLateParts) {
  StreetRun run;
  PlaceMemory memory = run.memory();
  run.begin_segment(1);
  for (int frame = 0; frame < 20; ++frame) run.add(frame);
  run.follow(&memory);
  memory.apply(EpochBegan{0, 8, 12});
  for (int frame = 0; frame < 12; ++frame) run.add(frame);
  // Places before the doubt are sought without the gap that one unit has.
  EXPECT_FALSE(run.follow(&memory).empty());
}

TEST(PlaceMemory, PassesOnKeyframesWhileTheyAreInTheWindow) {
  StreetRun run;
  PlaceMemory memory = run.memory();
  std::vector<StoredKeyframe> young, stored;
  memory.on_young([&](const StoredKeyframe& k) { young.push_back(k); });
  memory.on_stored([&](const StoredKeyframe& k) { stored.push_back(k); });
  run.begin_segment(1);
  run.begin(0), run.begin(1);
  run.follow(&memory);
  ASSERT_THAT(young, SizeIs(2));
  EXPECT_THAT(stored, IsEmpty());
  EXPECT_EQ(young[1].view->corners.px.size(), remember_view(*street_frame(1).pyramid).corners.px.size());
  // As the newest images show them, once more and when they leave.
  run.correct_camera(5);
  run.close();
  run.follow(&memory);
  ASSERT_THAT(young, SizeIs(4));
  ASSERT_THAT(stored, SizeIs(2));
  const RememberedView now = remember_view(*street_frame(5).pyramid);
  for (const StoredKeyframe& k : {young[3], stored[1]}) {
    EXPECT_EQ(k.id, 1);
    EXPECT_EQ(k.view->corners.px, now.corners.px);
  }
}

TEST(PathCovariance, GrowsAlongThePathAndTurnsWithIt) {
  PlaceStore store(street().pinhole());
  for (int i = 0; i < 5; ++i) {
    auto record = std::make_shared<KeyframeRecord>();
    record->T_world_cam = SE3(Eigen::Quaterniond(Eigen::AngleAxisd(0.2 * i, Eigen::Vector3d::UnitY())),
                              Eigen::Vector3d(0.3 * i, 0, i));
    store.add({i, 0, record, nullptr, std::nullopt});
  }
  EXPECT_TRUE(store.path_covariance(2, 2).isZero());
  EXPECT_LT(store.path_covariance(0, 1).trace(), store.path_covariance(0, 4).trace());
  // The covariance of the inverse motion, moved back, is that of the motion.
  const Matrix7d there = store.path_covariance(0, 4), back = store.path_covariance(4, 0);
  const Matrix7d A = Sim3{1, store.T_a_b(0, 4)}.adjoint();
  EXPECT_TRUE((A * back * A.transpose()).isApprox(there, 1e-9));
}

}  // namespace
}  // namespace edgevo
