// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Which places a view may show: two voters that fail differently. Corners that look alike, in an index of
// their descriptors, and the signature of the whole view. Their ranks are added, over the views of a few
// keyframes in a row. They only nominate; place_match.h proves.
#include <functional>
#include <memory>
#include <vector>

#include "edgevo/places/remembered_view.h"

namespace edgevo {

class CornerIndex;

/// What a row of queries along one path has said of the views so far, by number of the view.
struct PlaceVotes {
  /// By each of the two voters.
  std::vector<double> by_corners, by_signature;
};

/// The views of all places, in the order in which they were seen. Numbers of views ascend from 0.
class PlaceIndex {
 public:
  PlaceIndex();
  ~PlaceIndex();
  PlaceIndex(const PlaceIndex&) = delete;
  PlaceIndex& operator=(const PlaceIndex&) = delete;

  /// Adds a view; returns its number. Cost: about 0.3 ms.
  int add(const RememberedView& view);
  /// Number of views.
  size_t size() const { return signatures_.size(); }

  /// The likeliest views, likeliest first, none next to another one. The query must not be among the views,
  /// nor what was seen around it: its corners would look most alike. `row`: of the queries before it along
  /// the same path; takes what this one adds. Cost: 0.2 ms at 300 views, 3 ms at 10,000.
  std::vector<int> candidates(const RememberedView& query, size_t count, PlaceVotes* row) const;

 private:
  std::vector<double> votes_by_corners(const RememberedView& query) const;
  std::vector<double> votes_by_signature(const RememberedView& query) const;

  std::unique_ptr<CornerIndex> corners_;
  std::vector<ViewSignature> signatures_;
};

}  // namespace edgevo
