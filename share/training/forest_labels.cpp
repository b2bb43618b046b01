// SPDX-License-Identifier: BSD-3-Clause
#include "forest_labels.h"

#include <Eigen/Core>
#include <algorithm>

namespace edgevo::training {
namespace {

constexpr int kCell = 4, kCells = kInner / kCell;
using Counts = Eigen::Matrix<float, kCells * kCells, 1>;

// Number of edge pixels per cell, so that an edge shifted by a pixel has almost the same label.
Counts counts_of(const EdgePatch& patch) {
  Counts counts = Counts::Zero();
  for (int i = 0; i < kInner * kInner; ++i)
    if (patch[size_t(i)]) counts[i / kInner / kCell * kCells + i % kInner / kCell] += 1;
  return counts;
}

// Direction in which they differ most.
Counts main_direction(const std::vector<Counts>& centred, Random& random) {
  constexpr int kMax = 256, kRounds = 20;
  const size_t step = std::max<size_t>(1, centred.size() / kMax);
  Counts direction;
  for (int i = 0; i < direction.size(); ++i) direction[i] = float(random.uniform(-1, 1));
  for (int round = 0; round < kRounds; ++round) {
    Counts next = Counts::Zero();
    for (size_t i = 0; i < centred.size(); i += step) next += centred[i] * centred[i].dot(direction);
    if (next.norm() < 1e-12f) break;
    direction = next.normalized();
  }
  return direction;
}

}  // namespace

std::vector<uint8_t> two_classes(const std::vector<const EdgePatch*>& patches, Random& random) {
  std::vector<Counts> counts;
  Counts mean = Counts::Zero();
  for (const EdgePatch* p : patches) counts.push_back(counts_of(*p)), mean += counts.back();
  mean /= float(patches.size());
  for (Counts& c : counts) c -= mean;
  const Counts direction = main_direction(counts, random);
  std::vector<float> along;
  for (const Counts& c : counts) along.push_back(c.dot(direction));
  std::vector<float> sorted = along;
  std::nth_element(sorted.begin(), sorted.begin() + long(sorted.size() / 2), sorted.end());
  const float median = sorted[sorted.size() / 2];
  std::vector<uint8_t> classes;
  for (const float a : along) classes.push_back(a >= median);
  return classes;
}

const EdgePatch& most_typical(const std::vector<const EdgePatch*>& patches) {
  std::vector<float> mean(kInner * kInner, 0.0f);
  for (const EdgePatch* p : patches)
    for (size_t i = 0; i < mean.size(); ++i) mean[i] += float((*p)[i]) / float(patches.size());
  const auto difference = [&](const EdgePatch& p) {
    float sum = 0;
    for (size_t i = 0; i < mean.size(); ++i) sum += (float(p[i]) - mean[i]) * (float(p[i]) - mean[i]);
    return sum;
  };
  const EdgePatch* best = patches.front();
  float least = difference(*best);
  for (const EdgePatch* p : patches) {
    const float d = difference(*p);
    if (d < least) least = d, best = p;
  }
  return *best;
}

}  // namespace edgevo::training
