// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/places/place_index.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "corner_index.h"

namespace edgevo {
namespace {

// Corners of a view that are looked up: the strongest, which come first.
constexpr size_t kMaxQueryCorners = 120;
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
  std::vector<std::pair<double, int>> order;  // most votes first, of equal ones the view seen first
  for (size_t i = 0; i < votes.size(); ++i)
    if (votes[i] > 0) order.emplace_back(-votes[i], int(i));
  std::sort(order.begin(), order.end());
  std::vector<int> rank(votes.size(), int(votes.size()));
  for (size_t i = 0; i < order.size(); ++i) rank[size_t(order[i].second)] = int(i);
  return rank;
}

}  // namespace

PlaceIndex::PlaceIndex() : corners_(std::make_unique<CornerIndex>()) {}
PlaceIndex::~PlaceIndex() = default;

int PlaceIndex::add(const RememberedView& view) {
  const int number = int(signatures_.size());
  signatures_.push_back(view.signature);
  corners_->add(view.corners.descriptors, number);
  return number;
}

std::vector<double> PlaceIndex::votes_by_corners(const RememberedView& query) const {
  std::vector<double> votes(size(), 0);
  const size_t corners = std::min(query.corners.descriptors.size(), kMaxQueryCorners);
  for (size_t i = 0; i < corners; ++i) corners_->vote(query.corners.descriptors[i], &votes);
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
  // The better voter counts most: they fail differently. Of equal views the one seen first.
  std::vector<std::pair<double, int>> order;
  for (size_t i = 0; i < size(); ++i) order.emplace_back(1.0 / (1 + a[i]) + 1.0 / (1 + b[i]), -int(i));
  std::make_heap(order.begin(), order.end());
  std::vector<int> chosen;
  for (; !order.empty() && chosen.size() < count; order.pop_back()) {
    std::pop_heap(order.begin(), order.end());
    const int i = -order.back().second;
    const auto is_near = [&](int c) { return std::abs(c - i) < kApart; };
    if (std::none_of(chosen.begin(), chosen.end(), is_near)) chosen.push_back(i);
  }
  return chosen;
}

}  // namespace edgevo
