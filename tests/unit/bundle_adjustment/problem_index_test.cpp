// SPDX-License-Identifier: BSD-3-Clause
// Index of a problem by host, compared with a plain search.
#include "edgevo/bundle_adjustment/problem_index.h"

#include <gtest/gtest.h>

#include "support/bundle_adjustment_scene.h"

namespace edgevo {
namespace {

BaProblem scene() {
  test::SceneOptions o;
  o.points = 60;
  o.observed_share = 0.4;
  o.corners = 3;
  return test::make_scene(o);
}

TEST(ProblemIndex, HasEveryPointWithItsHostAndItsObservations) {
  const BaProblem p = scene();
  const ba::ProblemIndex index = ba::index_problem(p);
  ASSERT_EQ(index.points.size(), p.points.size());
  ASSERT_EQ(index.first_of_host.back(), int(p.points.size()));
  for (size_t h = 0; h < p.poses.size(); ++h)
    for (int n = index.first_of_host[h]; n < index.first_of_host[h + 1]; ++n) {
      EXPECT_EQ(p.points[index.points[n]].host, int(h));
      if (n > index.first_of_host[h]) {
        EXPECT_LT(index.points[n - 1], index.points[n]);
      }
    }
  ASSERT_EQ(index.first_observation.back(), int(p.observations.size()));
  for (size_t i = 0; i < p.points.size(); ++i)
    for (int k = index.first_observation[i]; k < index.first_observation[i + 1]; ++k)
      EXPECT_EQ(p.observations[k].point, int(i));
}

TEST(ProblemIndex, AHostsProblemHasItsPointsAndMatchesAmongThePoses) {
  const BaProblem p = scene();
  const ba::ProblemIndex index = ba::index_problem(p);
  for (const auto& [host, end] : {std::pair{0, 7}, {2, 5}, {6, 7}}) {
    const BaProblem part = ba::problem_of_host(p, index, host, end);
    EXPECT_EQ(part.pose_ids, std::vector<int>(p.pose_ids.begin() + host, p.pose_ids.begin() + end));
    EXPECT_FALSE(part.prior);
    size_t k = 0, points = 0;
    int last = -1;
    for (const BaObservation& o : p.observations) {
      if (p.points[o.point].host != host || o.target < host || o.target >= end) continue;
      ASSERT_LT(k, part.observations.size());
      const BaObservation& found = part.observations[k++];
      EXPECT_EQ(found.px, o.px);
      EXPECT_EQ(found.target, o.target - host);
      EXPECT_EQ(part.points[found.point].ray, p.points[o.point].ray);
      EXPECT_EQ(part.points[found.point].host, 0);
      points += o.point != last;
      last = o.point;
    }
    EXPECT_EQ(part.observations.size(), k);
    EXPECT_EQ(part.points.size(), points);
    size_t corners = 0;
    for (const BaCornerPair& c : p.corners) corners += c.from >= host && c.to < end;
    EXPECT_EQ(part.corners.size(), corners);
  }
}

}  // namespace
}  // namespace edgevo
