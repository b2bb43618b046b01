// SPDX-License-Identifier: BSD-3-Clause
// The edge lines of a run through the rendered street against its true edges. The bounds leave a margin to
// the measured figures (lab 2026-11-24_edge_map).
#include <gtest/gtest.h>

#include "street_run.h"
#include "true_edges.h"

namespace edgevo::test {
namespace {

class MapLines : public StreetRun {};

TEST_F(MapLines, LieAtTrueEdgesAndCoverMoreOfThemThanThePoints) {
  const TrueEdges truth(*renderer_, *run_, /*range=*/20, /*tolerance=*/0.1);
  const EdgeMapQuality quality = truth.evaluate(*run_);
  std::cout << "[ figures  ] " << quality << std::endl;
  EXPECT_GT(quality.completeness, 0.43);  // measured 0.50
  EXPECT_GT(quality.accuracy, 0.86);      // measured 0.91
  EXPECT_GT(quality.completeness, 1.4 * quality.points_completeness);
}

TEST_F(MapLines, HaveValidVertices) {
  for (const KeyframeRecord& k : run_->keyframes)
    for (const EdgeLine& line : k.lines) {
      ASSERT_GE(line.vertices.size(), 2u);
      for (const EdgeVertex& v : line.vertices) {
        ASSERT_GT(v.idepth, 0);
        ASSERT_GT(v.idepth_sigma, 0);
        ASSERT_TRUE(run_->pinhole.contains(v.px.cast<double>()));
      }
    }
}

}  // namespace
}  // namespace edgevo::test
