// SPDX-License-Identifier: BSD-3-Clause
// The mapper: from a bootstrap over a number of keyframes, fed with frames that it tracks itself.
#include "edgevo/mapping/mapper.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <memory>

#include "support/pose_matchers.h"
#include "sweep_driver.h"

namespace edgevo {
namespace {

using test::Sweep;
using test::sweep_pose;
using test::SweepDriver;

MappingParams mapping_of_seven_keyframes() {
  MappingParams p;
  p.window.keyframes = 7;
  return p;
}

// Length of the estimated step between two keyframes over that of the true one.
double step_scale(const SweepDriver& driver, const Keyframe& a, const Keyframe& b) {
  const double truth = (sweep_pose(driver.frame_of.at(b.id)).translation() -
                        sweep_pose(driver.frame_of.at(a.id)).translation())
                           .norm();
  return relative_pose(b, a).translation().norm() / truth;
}

TEST(Mapper, BuildsAMapFromABootstrap) {
  SweepDriver driver(mapping_of_seven_keyframes());
  ASSERT_EQ(driver.start(), "");
  const auto reference = driver.mapper.reference();
  ASSERT_TRUE(reference);
  EXPECT_EQ(reference->keyframe_id, driver.mapper.window().newest().id);
  EXPECT_EQ(driver.mapper.next_id(), reference->keyframe_id + 1);
  EXPECT_EQ(driver.mapper.window().newest().frame_index, 8);
  EXPECT_EQ(reference->T_keyframe_world.size(), driver.mapper.window().keyframes().size());
  ASSERT_GT(reference->cloud.points.size(), 100u);
  std::vector<double> relative;
  for (const CloudPoint& p : reference->cloud.points)
    relative.push_back(std::abs(p.idepth / Sweep::idepth(8, p.px.cast<double>()) - 1));
  EXPECT_LT(median(relative), 0.05);
}

TEST(Mapper, ReportsWhyTwoViewsMakeNoMap) {
  BootstrapResult bootstrap = test::true_bootstrap(0, 8);
  for (size_t v = 1; v < bootstrap.views.size(); ++v)  // every view shows another scene
    bootstrap.views[v].pyramid = test::HollowScene(70 + v).pyramid(sweep_pose(int(v)));
  Mapper mapper(Sweep::pinhole(), test::window_only(mapping_of_seven_keyframes()), {});
  const Reasons why = mapper.initialise(bootstrap);
  ASSERT_EQ(why.size(), 1u);
  EXPECT_EQ(why.front().kind, ReasonKind::kFewPointsMatched);
  EXPECT_EQ(mapper.next_id(), 0);
  EXPECT_TRUE(mapper.initialise(test::true_bootstrap(0, 8)).empty());  // the failure did no harm
}

TEST(Mapper, FifteenKeyframesKeepTheScale) {
  SweepDriver driver(mapping_of_seven_keyframes());
  ASSERT_EQ(driver.start(), "");
  int last_id = driver.mapper.next_id() - 1;
  constexpr int kKeyframes = 15, kFramesApart = 4;
  for (int k = 1; k <= kKeyframes; ++k)
    for (int i = 1; i <= kFramesApart; ++i) {
      const int f = 8 + kFramesApart * (k - 1) + i;
      const MapUpdate update = driver.process(f, i == kFramesApart);
      if (i != kFramesApart) {
        EXPECT_EQ(update.keyframe_id, -1);
        EXPECT_FALSE(update.adjustment);
        continue;
      }
      EXPECT_EQ(update.keyframe_id, ++last_id);
      EXPECT_GT(update.stats.matched_in_newest, 100) << "keyframe " << k;
      EXPECT_LT(update.stats.cost_per_observation, 1.5) << "keyframe " << k;
      ASSERT_TRUE(update.adjustment);
      EXPECT_EQ(update.adjustment->cost_per_match, update.stats.cost_per_observation);
      EXPECT_EQ(update.adjustment->matches_in_newest, update.stats.matched_in_newest);
      EXPECT_GE(update.adjustment->moved, 0);
      EXPECT_LE(driver.mapper.window().keyframes().size(), 7u);
    }
  std::vector<int> marginalised;
  for (const auto& event : driver.events.read())
    if (const auto* e = std::get_if<KeyframeMarginalised>(event.get())) marginalised.push_back(e->id);
  ASSERT_GE(marginalised.size(), 10u);
  for (size_t i = 1; i < marginalised.size(); ++i) EXPECT_EQ(marginalised[i], marginalised[i - 1] + 1);
  const auto& window = driver.mapper.window().keyframes();
  EXPECT_EQ(marginalised.back() + 1, window.front().id);
  for (size_t i = 2; i < window.size(); ++i)
    EXPECT_NEAR(step_scale(driver, window[i - 2], window[i]), 1, 0.15) << "step " << i;
  // At the end of the run, after a path of about 2.4: within 5 %.
  const SE3 T_first_last = window.back().T_cam_world.inverse(), truth = sweep_pose(window.back().frame_index);
  EXPECT_THAT(T_first_last, test::SE3Near(truth, 0.12, 0.02));
}

// The fewer points the window lacks, the fewer candidates it makes.
TEST(Mapper, MakesAsManyCandidatesAsItNeeds) {
  const auto candidates = [](int max_points) {
    MappingParams params = mapping_of_seven_keyframes();
    params.window.max_points = max_points;
    params.depth_filter.cell_px = 4;
    SweepDriver driver(params);
    EXPECT_EQ(driver.start(), "");
    driver.process(12, true);
    const Window& window = driver.mapper.window();
    const int lacking = std::max(0, max_points - window.active_points()),
              made = int(window.newest().immature.size());
    EXPECT_LE(made, std::max(300, int(params.depth_filter.candidates_per_point * lacking))) << max_points;
    return made;
  };
  const int full = candidates(200), empty = candidates(4000);
  EXPECT_GT(full, 100);
  EXPECT_GT(empty, 2 * full);
}

// No point can be matched in as many keyframes as required, and none is passed on: tentative points keep the
// map alive.
MappingParams params_of_a_sparse_map() {
  MappingParams params = mapping_of_seven_keyframes();
  params.window.min_matches = 10;
  params.window.pass_on_points = false;
  return params;
}

TEST(Mapper, ASparseMapGetsTentativePoints) {
  const MappingParams params = params_of_a_sparse_map();
  SweepDriver driver(params);
  ASSERT_EQ(driver.start(), "");
  for (int step = 1; step <= 15; ++step)
    driver.process(8 + 3 * step, true);  // every frame is a keyframe: one depth each
  EXPECT_GT(driver.mapper.reference()->known_points, 60);
  // Only those of the last keyframe: earlier ones have been kept or demoted.
  const CellGrid grid(Sweep::pinhole().width, Sweep::pinhole().height, kActivationCellPx);
  int tentative = 0;
  for (const Keyframe& k : driver.mapper.window().keyframes())
    for (const MapPoint& p : k.points) tentative += p.tentative;
  EXPECT_GT(tentative, 0);
  EXPECT_LE(tentative, grid.size() / 4);
}

TEST(Mapper, WithoutTentativePointsASparseMapGetsNone) {
  MappingParams params = params_of_a_sparse_map();
  params.window.use_tentative_points = false;
  SweepDriver driver(params);
  ASSERT_EQ(driver.start(), "");
  const int before = driver.mapper.window().active_points();
  driver.process(11, true);
  EXPECT_LE(driver.mapper.window().active_points(), before);
  for (const Keyframe& k : driver.mapper.window().keyframes())
    for (const MapPoint& p : k.points) EXPECT_FALSE(p.tentative);
}

TEST(Mapper, APublishedReferenceDoesNotChange) {
  SweepDriver driver(mapping_of_seven_keyframes());
  ASSERT_EQ(driver.start(), "");
  const auto before = driver.mapper.reference();
  const int id = before->keyframe_id;
  const size_t points = before->cloud.points.size();
  const double first = before->cloud.points.front().idepth;
  driver.process(10, false);
  EXPECT_EQ(driver.mapper.reference(), before);  // no keyframe, no new reference
  driver.process(12, true);
  EXPECT_NE(driver.mapper.reference(), before);
  EXPECT_EQ(before->keyframe_id, id);
  EXPECT_EQ(before->cloud.points.size(), points);
  EXPECT_EQ(before->cloud.points.front().idepth, first);
}

TEST(Mapper, SkipsAFrameWhoseReferenceIsGone) {
  SweepDriver driver(mapping_of_seven_keyframes());
  ASSERT_EQ(driver.start(), "");
  driver.note_keyframes();
  TrackedFrame late = driver.align(10, true);
  late.reference_id = 4711;
  const auto before = driver.mapper.reference();
  EXPECT_EQ(driver.mapper.process(late).keyframe_id, -1);
  EXPECT_EQ(driver.mapper.reference(), before);
}

TEST(Mapper, AKeyframeKeepsTheCornersOfItsFrame) {
  SweepDriver driver(mapping_of_seven_keyframes());
  ASSERT_EQ(driver.start(), "");
  driver.note_keyframes();
  TrackedFrame frame = driver.align(12, true);
  frame.corners.assign(70, {Eigen::Vector3d(0.1, 0.2, 1), Eigen::Vector3d(0.15, 0.2, 1)});
  driver.mapper.process(frame);
  EXPECT_EQ(driver.mapper.window().newest().corners_from, frame.reference_id);
  EXPECT_EQ(driver.mapper.window().newest().corners.size(), 70u);
  driver.process(16, true);
  EXPECT_EQ(driver.mapper.window().newest().corners_from, -1);
}

TEST(Mapper, SeedsOnlyWhereTheMapHasNoPoint) {
  SweepDriver driver(mapping_of_seven_keyframes());
  ASSERT_EQ(driver.start(), "");
  driver.process(12, true);
  const DepthFilterParams params;
  const CellGrid grid(320, 240, params.cell_px);
  std::vector<bool> known(size_t(grid.size()), false);
  for (const CloudPoint& p : driver.mapper.window().cloud(driver.mapper.window().newest()))
    known[size_t(grid.index(p.px.x(), p.px.y()))] = true;
  const Keyframe& newest = driver.mapper.window().newest();
  EXPECT_GT(newest.immature.size(), 20u);
  for (const ImmaturePoint& p : newest.immature) EXPECT_FALSE(known[size_t(grid.index(p.px.x(), p.px.y()))]);
}

TEST(Mapper, ClosingMarginalisesAllKeyframes) {
  SweepDriver driver(mapping_of_seven_keyframes());
  ASSERT_EQ(driver.start(), "");
  driver.process(12, true);
  const size_t in_window = driver.mapper.window().keyframes().size();
  driver.mapper.close();
  EXPECT_EQ(driver.mapper.reference(), nullptr);
  const auto& stored = driver.mapper.map().stored();
  EXPECT_EQ(stored.size(), in_window);
  EXPECT_EQ(stored.rbegin()->second.keyframe->frame_index, 12);
  EXPECT_TRUE(driver.mapper.map().marginalised().empty());
  const int next = driver.mapper.next_id();
  ASSERT_EQ(driver.start(20, 28), "");  // the ids of the next segment continue
  EXPECT_EQ(driver.mapper.window().keyframes().front().id, next);
}

TEST(Mapper, TheUnitOfTheBootstrapIsKept) {
  SweepDriver driver(mapping_of_seven_keyframes());
  ASSERT_EQ(driver.start(0, 8, 3.0), "");
  for (int f = 9; f <= 16; ++f) driver.process(f, f % 4 == 0);
  const auto& window = driver.mapper.window().keyframes();
  EXPECT_NEAR(step_scale(driver, window.front(), window.back()), 3, 0.15);
}

TEST(Mapper, TheSameSeedGivesTheSameMap) {
  const auto run = [](uint64_t seed) {
    SweepDriver driver(mapping_of_seven_keyframes(), seed);
    EXPECT_EQ(driver.start(), "");
    for (int f = 9; f <= 16; ++f) driver.process(f, f % 4 == 0);
    std::vector<double> values;
    for (const CloudPoint& p : driver.mapper.reference()->cloud.points) values.push_back(p.idepth);
    return values;
  };
  EXPECT_EQ(run(1), run(1));
  EXPECT_NE(run(1), run(2));
}

// ---- doubt ----

constexpr int kApart = 4;  // frames

TrackedFrame next_keyframe(SweepDriver* driver, int k, bool is_in_doubt) {
  driver->note_keyframes();
  TrackedFrame frame = driver->align(8 + kApart * k, true);
  frame.is_in_doubt = is_in_doubt;
  return frame;
}

std::vector<bool> doubtful_ones(SweepDriver* driver) {
  std::vector<bool> doubtful;
  for (const auto& event : driver->events.read())
    if (const auto* e = std::get_if<KeyframeMarginalised>(event.get()))
      doubtful.push_back(e->keyframe->is_doubtful);
  return doubtful;
}

TEST(Mapper, KeyframesMadeInDoubtLeaveAsDoubtful) {
  SweepDriver driver(mapping_of_seven_keyframes());
  ASSERT_EQ(driver.start(), "");
  for (int k = 1; k <= 15; ++k) driver.mapper.process(next_keyframe(&driver, k, k == 6 || k == 7));
  driver.note_keyframes();
  const std::vector<bool> doubtful = doubtful_ones(&driver);
  // The doubt at frame 32 reaches back to frame 23.
  EXPECT_EQ(std::count(doubtful.begin(), doubtful.end(), true), 4);
  const auto& window = driver.mapper.window().keyframes();
  EXPECT_FALSE(window.back().is_doubtful);
  for (size_t i = 2; i < window.size(); ++i)
    EXPECT_NEAR(step_scale(driver, window[i - 2], window[i]), 1, 0.15) << "step " << i;
}

TEST(Mapper, ConfirmedKeyframesAreNoLongerDoubtful) {
  SweepDriver driver(mapping_of_seven_keyframes());
  ASSERT_EQ(driver.start(), "");
  for (int k = 1; k <= 10; ++k) {
    TrackedFrame frame = next_keyframe(&driver, k, k == 4);
    frame.confirms_map = k == 7;
    driver.mapper.process(frame);
  }
  driver.mapper.close();
  for (const bool doubtful : doubtful_ones(&driver)) EXPECT_FALSE(doubtful);
}

}  // namespace
}  // namespace edgevo
