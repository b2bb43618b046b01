// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Scores poses by their inliers alone, for tests of the alignment.
#include "edgevo/alignment/pose_choice.h"

namespace edgevo::test {

/// A pose with 40 % inliers fits; more inliers than the 15 % of a wrong pose score higher.
class InlierScorer final : public PoseScorer {
 public:
  bool fits(const PoseCandidate& pose) const override { return pose.evidence.inlier_share >= 0.4; }
  double score(const PoseCandidate& pose) const override {
    return (pose.evidence.inlier_share - 0.15) * pose.evidence.weight;
  }
};

}  // namespace edgevo::test
