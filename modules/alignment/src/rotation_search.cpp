// SPDX-License-Identifier: BSD-3-Clause
#include "rotation_search.h"

#include <algorithm>
#include <cmath>

#include "edgevo/alignment/projection.h"
#include "edgevo/core/robust.h"

namespace edgevo {
namespace {

// Pixels of the coarsest level: the basins of convergence of neighbours on the grid overlap.
constexpr double kStepPx = 2.0;
constexpr int kYawSteps = 9, kPitchSteps = 5;  // in each direction: cameras yaw more than they pitch
constexpr size_t kPatches = 200;               // compared, of about 1500: enough for a mean
constexpr size_t kBest = 3;  // rotations returned: on so coarse a level the best may be wrong
// Minimum distance between returned rotations, in steps: closer ones converge to the same pose.
constexpr int kApartSteps = 2;

struct Candidate {
  double score = 0;
  int yaw = 0, pitch = 0;
};

// Mean robust difference of every `step`-th patch on one level.
double mean_difference(const PyramidLevel& level, const ReferenceCloud& cloud, const PatchTemplates& patches,
                       size_t step, const SE3& T_cur_ref) {
  const Eigen::Matrix3d R = T_cur_ref.R();
  const Eigen::Vector3d t = T_cur_ref.translation();
  const double unrelated = huber_cost(std::sqrt(kUnrelatedMeanSquare), kPatchHuber);
  double sum = 0;
  int count = 0;
  for (size_t i = 0; i < patches.size(); i += step) {
    if (!patches[i].usable) continue;
    ++count;
    const Projection p = project(level.pinhole, R, t, cloud.points[i].ray, cloud.points[i].idepth);
    const PatchDifference d = p.valid ? compare_gray(level, patches[i], p.px) : PatchDifference();
    sum +=
        d.usable ? std::min(unrelated, huber_cost(std::sqrt(double(d.mean_square)), kPatchHuber)) : unrelated;
  }
  return count > 0 ? sum / count : unrelated;
}

}  // namespace

std::vector<SE3> search_rotation(const FramePyramid& current, const ReferenceCloud& cloud,
                                 const SE3& T_predicted) {
  const size_t coarsest = current.levels.size() - 1;
  const PyramidLevel& level = current.levels[coarsest];
  const PatchTemplates& patches = cloud.patches[coarsest];
  const size_t step = std::max<size_t>(1, patches.size() / kPatches);
  const double angle = kStepPx / level.pinhole.fx;
  const auto turned = [&](int yaw, int pitch) {
    Vector6d xi = Vector6d::Zero();
    xi.tail<3>() << angle * pitch, angle * yaw, 0;
    return SE3::exp(xi) * T_predicted;
  };
  std::vector<Candidate> grid;
  for (int pitch = -kPitchSteps; pitch <= kPitchSteps; ++pitch)
    for (int yaw = -kYawSteps; yaw <= kYawSteps; ++yaw)
      grid.push_back({mean_difference(level, cloud, patches, step, turned(yaw, pitch)), yaw, pitch});
  std::stable_sort(grid.begin(), grid.end(),
                   [](const Candidate& a, const Candidate& b) { return a.score < b.score; });
  std::vector<Candidate> best;
  for (const Candidate& c : grid) {
    const bool known = std::any_of(best.begin(), best.end(), [&](const Candidate& b) {
      return std::abs(b.yaw - c.yaw) < kApartSteps && std::abs(b.pitch - c.pitch) < kApartSteps;
    });
    if (!known) best.push_back(c);
    if (best.size() == kBest) break;
  }
  std::vector<SE3> starts;
  for (const Candidate& c : best) starts.push_back(turned(c.yaw, c.pitch));
  return starts;
}

}  // namespace edgevo
