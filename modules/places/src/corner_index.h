// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The corners of all views, by their descriptors: those most alike to one, without looking at all.
#include <cstdint>
#include <vector>

#include "edgevo/places/remembered_view.h"

namespace edgevo {

/// Corners of views. A corner is found where one of sixteen parts of 16 bits is the same: 96 % of those of
/// which a tenth of the bits differs, 71 % of 15 %. Memory: 110 bytes a corner, 25 MB at first.
class CornerIndex {
 public:
  /// Adds the corners of a view. Cost: some 0.3 ms for 400.
  void add(const std::vector<CornerDescriptor>& corners, int view);

  /// Adds a vote to each view that has one of the corners that are most alike to this one. Cost: 3 us among a
  /// hundred thousand corners, 20 us among four million.
  void vote(const CornerDescriptor& corner, std::vector<double>* votes) const;

 private:
  // Within one line of the processor's cache.
  struct alignas(sizeof(CornerDescriptor)) Descriptor {
    CornerDescriptor bits;
  };
  struct Alike {
    int bits;
    int32_t corner;
    bool operator<(const Alike& o) const { return bits != o.bits ? bits < o.bits : corner > o.corner; }
  };
  std::vector<int32_t> sharing_a_part(const CornerDescriptor& corner) const;
  std::vector<Alike> most_alike(const CornerDescriptor& corner) const;

  std::vector<Descriptor> descriptors_;
  std::vector<int> view_of_;                   // by number of the corner
  std::vector<std::vector<int32_t>> sharing_;  // numbers of corners by part and its bits
};

}  // namespace edgevo
