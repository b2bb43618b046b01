// SPDX-License-Identifier: BSD-3-Clause
#include "corner_index.h"

#include <algorithm>
#include <cstring>

#include "differing_bits.h"

namespace edgevo {
namespace {

// Parts of a descriptor. Fewer and longer parts of which a bit may differ find a few more, for ten times the
// time.
using Part = uint16_t;
constexpr size_t kParts = sizeof(CornerDescriptor) / sizeof(Part);
constexpr size_t kValues = size_t(1) << (8 * sizeof(Part));
// Corners that one votes for, and how alike they must be: half of all bits differ by chance.
constexpr size_t kNearest = 8;
constexpr int kMaxVoteBits = 70;

// Where the list of those that share part `i` is.
size_t list_of(const CornerDescriptor& corner, size_t i) {
  Part part;
  std::memcpy(&part, &corner[i * sizeof(Part)], sizeof part);
  return i * kValues + part;
}

}  // namespace

void CornerIndex::add(const std::vector<CornerDescriptor>& corners, int view) {
  sharing_.resize(kParts * kValues);
  for (const CornerDescriptor& corner : corners) {
    for (size_t i = 0; i < kParts; ++i) sharing_[list_of(corner, i)].push_back(int32_t(descriptors_.size()));
    descriptors_.push_back({corner});
    view_of_.push_back(view);
  }
}

// Descriptors lie anywhere in memory: the processor fetches them while the rest is gathered.
std::vector<int32_t> CornerIndex::sharing_a_part(const CornerDescriptor& corner) const {
  std::vector<int32_t> found;
  for (size_t i = 0; i < kParts; ++i) __builtin_prefetch(&sharing_[list_of(corner, i)]);
  for (size_t i = 0; i < kParts; ++i)
    for (const int32_t other : sharing_[list_of(corner, i)]) {
      __builtin_prefetch(&descriptors_[size_t(other)]);
      found.push_back(other);
    }
  return found;
}

std::vector<CornerIndex::Alike> CornerIndex::most_alike(const CornerDescriptor& corner) const {
  std::vector<Alike> nearest;  // ascending
  for (const int32_t other : sharing_a_part(corner)) {
    const Alike alike{differing_bits(corner, descriptors_[size_t(other)].bits), other};
    if (alike.bits > kMaxVoteBits || (nearest.size() == kNearest && !(alike < nearest.back()))) continue;
    const auto at = std::lower_bound(nearest.begin(), nearest.end(), alike);
    if (at != nearest.end() && at->corner == other) continue;  // shares another part, too
    nearest.insert(at, alike);
    if (nearest.size() > kNearest) nearest.pop_back();
  }
  return nearest;
}

void CornerIndex::vote(const CornerDescriptor& corner, std::vector<double>* votes) const {
  if (descriptors_.empty()) return;
  std::vector<int> views;
  for (const Alike& alike : most_alike(corner)) views.push_back(view_of_[size_t(alike.corner)]);
  std::sort(views.begin(), views.end());
  views.erase(std::unique(views.begin(), views.end()), views.end());
  for (const int view : views) (*votes)[size_t(view)] += 1;
}

}  // namespace edgevo
