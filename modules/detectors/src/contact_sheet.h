#pragma once
// Some frames of a source with their edges, and the probability beside them, as one picture.
#include <map>
#include <optional>
#include <string>

#include "edgevo/core/image.h"
#include "edgevo/edges/edge_params.h"

namespace edgevo {

class ContactSheet {
 public:
  static constexpr int kFrames = 6;

  /// `size` of the source: the frames are spread over it; the first ones, where it is not known.
  explicit ContactSheet(std::optional<int> size);
  /// A frame of the source, in its order; kept if it is one of the sheet's.
  void offer(const Frame& frame);
  /// Writes folder/contact_sheet.jpg, with the probabilities that are in the folder by now, and the edges
  /// that `edges.detector` makes of them. Nothing without a frame. Throws InputError.
  void write(const std::string& folder, const EdgeParams& edges) const;

 private:
  std::optional<int> size_;
  int offered_ = 0;
  std::map<int, Frame> kept_;
};

}  // namespace edgevo
