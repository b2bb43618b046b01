// The lines of edges of a drive through the rendered street against its true edges. Bounds leave room to what
// was measured (share/lab/archive/2026-11-24_edge_map.md).
#include <gtest/gtest.h>

#include "street_drive.h"
#include "true_edges.h"

namespace edgevo::test {
namespace {

class EdgeMap : public StreetDrive {};

TEST_F(EdgeMap, LinesLieAtTrueEdgesAndCoverMoreOfThemThanThePoints) {
  const TrueEdges truth(*renderer_, *run_, /*range=*/20, /*tolerance=*/0.1);
  const EdgeMapQuality quality = truth.judge(*run_);
  std::cout << "[ figures  ] " << quality << std::endl;
  EXPECT_GT(quality.completeness, 0.43);  // measured 0.50
  EXPECT_GT(quality.accuracy, 0.86);      // measured 0.91
  EXPECT_GT(quality.completeness, 1.4 * quality.points_completeness);
}

TEST_F(EdgeMap, EveryLineIsWhole) {
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
