// SPDX-License-Identifier: BSD-3-Clause
// The edge lines of a run through the rendered street against its true edges. The bounds leave a margin to
// the measured figures.
#include <gtest/gtest.h>

#include <utility>

#include "street_run.h"
#include "true_edges.h"

namespace edgevo::test {
namespace {

class MapLines : public StreetRun {};

TEST_F(MapLines, LieAtTrueEdgesAndCoverMoreOfThemThanThePoints) {
  const TrueEdges truth(*renderer_, *run_, /*range=*/20, /*tolerance=*/0.1);
  const EdgeMapQuality quality = truth.evaluate(*run_);
  std::cout << "[ figures  ] " << quality << std::endl;
  EXPECT_GT(quality.completeness, 0.68);  // measured 0.76
  EXPECT_GT(quality.accuracy, 0.72);  // measured 0.75: of 0.1 m, which a third of the vertices do not claim
  EXPECT_GT(quality.completeness, 1.4 * quality.points_completeness);
}

// Of the run's lines, the pieces whose depth is certain to `share`.
Run certain_lines(Run run, float share) {
  for (KeyframeRecord& k : run.keyframes) {
    std::vector<EdgeLine> lines;
    for (const EdgeLine& line : k.lines) {
      bool continues = false;
      for (const EdgeVertex& v : line.vertices) {
        const bool is_certain = v.idepth_sigma <= share * v.idepth;
        if (is_certain && !std::exchange(continues, true)) lines.emplace_back();
        if (is_certain)
          lines.back().vertices.push_back(v);
        else
          continues = false;
      }
    }
    k.lines = std::move(lines);
  }
  return run;
}

TEST_F(MapLines, SayWhichOfThemAreCertain) {
  const TrueEdges truth(*renderer_, *run_, /*range=*/20, /*tolerance=*/0.1);
  const EdgeMapQuality quality = truth.evaluate(certain_lines(*run_, 0.007f));
  std::cout << "[ figures  ] " << quality << std::endl;
  EXPECT_GT(quality.completeness, 0.40);
  EXPECT_GT(quality.accuracy, 0.86);
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
