// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/places/place_index.h"

#include <faiss/IndexBinaryHash.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>

namespace edgevo {
namespace {

constexpr int kBits = 256;
// Descriptors are found where one of sixteen parts of 16 bits is the same: 96 % of those of which a tenth of
// the bits differs, 71 % of 15 %. Fewer and longer parts of which a bit may differ find a few more, for ten
// times the time.
constexpr int kTables = 16, kTableBits = 16;
// Places that one corner supports, and how alike they must be: half of all bits differ by chance.
constexpr size_t kNearest = 8;
constexpr int kMaxVoteBits = 70;
// Corners of a view that are looked up: the strongest, which come first.
constexpr size_t kMaxQueryCorners = 120;
// More queries at a time faiss shares between threads, which belong to the frames.
constexpr size_t kInOneThread = 100;
// What a query says of a view, the next one says of its neighbours; so much of it is kept, and so far do two
// views in a row lie apart: five or so in a row count.
constexpr double kKept = 0.8;
constexpr int kReach = 3;
// Candidates are not neighbours of each other.
constexpr int kApart = 6;

// Votes of a row of queries: those of the last one, and of those before it where they may have been.
std::vector<double> carried_on(const std::vector<double>& before, std::vector<double> now) {
  const int size = int(std::min(before.size(), now.size()));
  for (int i = 0; i < int(now.size()); ++i) {
    double most = 0;
    for (int j = std::max(0, i - kReach); j < std::min(size, i + kReach + 1); ++j)
      most = std::max(most, before[size_t(j)]);
    now[size_t(i)] += kKept * most;
  }
  return now;
}

// Ranks by votes, from 0 for the most; without votes the last rank.
std::vector<int> ranks_of(const std::vector<double>& votes) {
  std::vector<int> order(votes.size()), rank(votes.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(),
                   [&](int a, int b) { return votes[size_t(a)] > votes[size_t(b)]; });
  for (size_t i = 0; i < order.size(); ++i)
    rank[size_t(order[i])] = int(votes[size_t(order[i])] > 0 ? i : order.size());
  return rank;
}

// faiss reads its 16 bits in words of 64, so up to six bytes after the last descriptor: a copy with one more.
std::vector<CornerDescriptor> readable_by_faiss(const std::vector<CornerDescriptor>& descriptors,
                                                size_t count) {
  std::vector<CornerDescriptor> copy(count + 1);
  std::copy_n(descriptors.begin(), count, copy.begin());
  return copy;
}

}  // namespace

struct PlaceIndex::Corners {
  Corners() : hash(kBits, kTables, kTableBits) {}
  faiss::IndexBinaryMultiHash hash;
  std::vector<int> view_of;  // by number of the descriptor
};

PlaceIndex::PlaceIndex() : corners_(std::make_unique<Corners>()) {}
PlaceIndex::~PlaceIndex() = default;

int PlaceIndex::add(const RememberedView& view) {
  const int number = int(signatures_.size());
  signatures_.push_back(view.signature);
  const size_t count = view.corners.descriptors.size();
  corners_->hash.add(faiss::IndexBinary::idx_t(count),
                     readable_by_faiss(view.corners.descriptors, count).front().data());
  corners_->view_of.resize(corners_->view_of.size() + count, number);
  return number;
}

std::vector<double> PlaceIndex::votes_by_corners(const RememberedView& query) const {
  std::vector<double> votes(size(), 0);
  const size_t corners = std::min(query.corners.descriptors.size(), kMaxQueryCorners);
  const std::vector<CornerDescriptor> d = readable_by_faiss(query.corners.descriptors, corners);
  std::vector<int32_t> distances(corners * kNearest);
  std::vector<faiss::IndexBinary::idx_t> found(distances.size(), -1);
  for (size_t i = 0; i < corners && !corners_->view_of.empty(); i += kInOneThread)
    corners_->hash.search(faiss::IndexBinary::idx_t(std::min(kInOneThread, corners - i)), d[i].data(),
                          kNearest, &distances[i * kNearest], &found[i * kNearest]);
  for (size_t i = 0; i < corners; ++i) {
    std::set<int> views;
    for (size_t at = i * kNearest; at < (i + 1) * kNearest; ++at)
      if (found[at] >= 0 && distances[at] <= kMaxVoteBits) views.insert(corners_->view_of[size_t(found[at])]);
    for (const int view : views) votes[size_t(view)] += 1;
  }
  return votes;
}

// As far as a view is more like the query than the half of all bits that differ by chance.
std::vector<double> PlaceIndex::votes_by_signature(const RememberedView& query) const {
  constexpr int kHalf = ViewSignature::kColumns * ViewSignature::kRows * ViewSignature::kDirections / 2;
  std::vector<double> votes(size(), 0);
  for (size_t i = 0; i < size(); ++i)
    votes[i] = std::max(0, kHalf - distance(query.signature, signatures_[i]));
  return votes;
}

std::vector<int> PlaceIndex::candidates(const RememberedView& query, size_t count, PlaceVotes* row) const {
  if (size() == 0) return {};
  row->by_corners = carried_on(row->by_corners, votes_by_corners(query));
  row->by_signature = carried_on(row->by_signature, votes_by_signature(query));
  const std::vector<int> a = ranks_of(row->by_corners), b = ranks_of(row->by_signature);
  std::vector<int> order(size(), 0);
  std::iota(order.begin(), order.end(), 0);
  // The better voter counts most: they fail differently.
  const auto key = [&](int i) { return 1.0 / (1 + a[size_t(i)]) + 1.0 / (1 + b[size_t(i)]); };
  std::stable_sort(order.begin(), order.end(), [&](int i, int j) { return key(i) > key(j); });
  std::vector<int> chosen;
  for (const int i : order) {
    if (chosen.size() == count) break;
    const auto is_near = [&](int c) { return std::abs(c - i) < kApart; };
    if (std::none_of(chosen.begin(), chosen.end(), is_near)) chosen.push_back(i);
  }
  return chosen;
}

}  // namespace edgevo
