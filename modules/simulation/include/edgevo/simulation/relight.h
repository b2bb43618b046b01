// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Lighting and camera effects on any image sequence, to test an odometry under changing brightness.
//
// Kinds, all driven by the seed and the time of the frame:
//   drift     gain and bias wander slowly (gain 0.6 to 1.7, bias +-25 gray levels)
//   jumps     exposure steps by up to a factor 2.2 either way every one to four seconds, and recovers within
//             a second
//   gamma     the response curve bends, exponent 0.6 to 1.6
//   vignette  the corners keep 35 % of their brightness
//   glare     a saturated blob moves over the image, with a veil around it
//   blooming  over-exposed sky blooms up to six pixels into the foreground
//   shadows   bands of 40 % brightness with soft rims sweep across
//   blur      a box of up to nine pixels along a wandering direction
//   noise     normal, standard deviation 8 gray levels
//   dropped   one frame in twelve is missing
//   mixed     all but blur and dropped together, noise and glare weaker
// Geometry, names, times and calibration stay as they are. The result for a frame depends on kind, seed, its
// number and its time only: the same bytes each time, in any order, from any thread. Cost: 1 to 10 ms for
// 1241x376.
#include <cstdint>
#include <string>
#include <vector>

#include "edgevo/core/image.h"
#include "edgevo/core/random.h"

namespace edgevo {

/// The kinds above, in that order.
const std::vector<std::string>& relight_kinds();

/// One kind of lighting change. Stateless; any thread.
class Relight {
 public:
  /// Throws InputError for an unknown kind.
  Relight(const std::string& kind, uint64_t seed);

  /// The image under changed light; `seconds` since the first frame of the sequence.
  GrayImage apply(const GrayImage& image, int index, double seconds) const;
  /// True if the frame is to be skipped.
  bool drops(int index) const;
  /// True if drops() is true for some frames.
  bool may_drop() const { return has("dropped"); }

 private:
  bool has(const char* effect) const;
  std::string kind_;
  uint64_t seed_;
};

}  // namespace edgevo
