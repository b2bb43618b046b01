// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// One picture with some frames of a source and their edges, next to their probabilities.
#include <map>
#include <optional>
#include <string>

#include "edgevo/core/image.h"
#include "edgevo/edges/edge_params.h"

namespace edgevo {

/// Collects frames and writes the picture.
class ContactSheet {
 public:
  /// Number of frames in the picture.
  static constexpr int kFrames = 6;

  /// Spreads the frames over a source of `size` frames; without a size it takes the first ones.
  explicit ContactSheet(std::optional<int> size);
  /// Passes a frame of the source, in order; it is kept if it belongs to the picture.
  void offer(const Frame& frame);
  /// Writes folder/contact_sheet.jpg from the probabilities in the folder and the edges that `edges.detector`
  /// makes of them. Writes nothing without a frame. Throws InputError.
  void write(const std::string& folder, const EdgeParams& edges) const;

 private:
  std::optional<int> size_;
  int offered_ = 0;
  std::map<int, Frame> kept_;
};

}  // namespace edgevo
