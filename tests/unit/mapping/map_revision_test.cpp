// All keyframes so far as one problem for the self-calibration: every point where they are few, a share of them where they are many.
#include "../../../modules/mapping/src/map_revision.h"

#include <gtest/gtest.h>

#include "unit/mapping/mapping_scene.h"

namespace edgevo {
namespace {

// Two keyframes; the first hosts `n` points, each matched in the second.
std::vector<Keyframe> two_keyframes(int n) {
  std::vector<Keyframe> keyframes(2);
  for (int k = 0; k < 2; ++k) {
    keyframes[k].id = k;
    keyframes[k].T_cam_world = test::sweep_pose(4 * k).inverse();
  }
  for (int i = 0; i < n; ++i) {
    MapPoint p;
    p.px = {20.0 + i % 280, 20.0 + i / 280};
    p.normal = {1, 0};
    p.idepth = 0.1;
    Observation o;
    o.keyframe_id = 1;
    o.match.px = p.px;
    o.match.normal = p.normal;
    o.match.inv_sigma_normal = 1;
    p.observations.push_back(o);
    keyframes[0].points.push_back(p);
  }
  return keyframes;
}

CalibrationHistory history_of(const std::vector<Keyframe>& keyframes) {
  return make_history(test::Sweep::pinhole(), 0, {&keyframes[0], &keyframes[1]});
}

TEST(CalibrationHistory, HoldsAllPointsWhereTheyAreFew) {
  const CalibrationHistory h = history_of(two_keyframes(1000));
  EXPECT_EQ(h.problem.file.points.size(), 1000u);
  EXPECT_EQ(h.problem.file.observations.size(), 1000u);
}

TEST(CalibrationHistory, HoldsAShareOfThePointsWhereTheyAreMany) {
  const std::vector<Keyframe> keyframes = two_keyframes(20000);
  const CalibrationHistory h = history_of(keyframes);
  EXPECT_GE(h.problem.file.points.size(), 4000u);
  EXPECT_LE(h.problem.file.points.size(), 7000u);
  ASSERT_EQ(h.point_index[0].size(), 20000u);
  size_t used = 0;
  for (size_t i = 0; i < 20000; ++i) {
    const int index = h.point_index[0][i];
    if (index < 0) continue;
    ++used;
    EXPECT_EQ(h.problem.px_host[index], keyframes[0].points[i].px);
  }
  EXPECT_EQ(used, h.problem.file.points.size());
}

}  // namespace
}  // namespace edgevo
