// What a correction of the camera does to the keyframes that have retired.
#include "run_records.h"

#include <gtest/gtest.h>

#include "edgevo/core/point_filter.h"
#include "support/sweep_scene.h"

namespace edgevo {
namespace {

// A point that the correction moves out to infinity is no more certain for it: its deviation follows the unit of
// length, not its own inverse depth.
TEST(RunRecords, ARevisionLeavesTheDeviationOfAFarPoint) {
  RunRecords records(test::Sweep::pinhole());
  records.begin_segment(0, test::true_bootstrap(0, 4), std::nullopt);
  Keyframe keyframe;
  keyframe.pyramid = test::Sweep::pyramid(0);
  MapPoint point;
  point.px = {100, 100};
  point.normal = {1, 0};
  point.idepth = 1e-3, point.idepth_sigma = 1e-4;
  keyframe.points = {point};
  records.retire({keyframe}, 0);
  RevisedKeyframe revised;
  revised.length_ratio = 2;
  revised.points = {{{100, 100}, 1e-6}};
  records.revise({revised});
  const edgevo::Run run = records.finish();
  ASSERT_EQ(run.keyframes.size(), 1u);
  const EdgePoint& moved = run.keyframes[0].points.at(0);
  EXPECT_FLOAT_EQ(moved.idepth, 1e-6f);
  EXPECT_FLOAT_EQ(moved.idepth_sigma, 0.5e-4f);
  EXPECT_FALSE(PointFilter().keeps(moved));
}

}  // namespace
}  // namespace edgevo
