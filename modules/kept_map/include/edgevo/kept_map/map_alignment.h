// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// How a map lies in another one, by the places that both show. The first is left as it is; the second is
// turned, scaled and bent to it as a run is that localises in the first.
#include <optional>
#include <vector>

#include "edgevo/kept_map/kept_map.h"
#include "edgevo/places/stated_place.h"

namespace edgevo {

/// Keyframes of map `b` recognised in map `a`, by their positions in the stores of both. Cost: 20 ms a
/// keyframe of `b`.
std::vector<StatedPlace> find_places(const KeptMap& a, const KeptMap& b);

/// How a map lies in another one.
struct MapAlignment {
  /// From the second map to the first, for each keyframe of the second.
  std::vector<Sim3> T_a_b;
  /// The places that agree with each other and with both maps.
  std::vector<StatedPlace> places;
};

/// Aligns map `b` with map `a`; nothing if fewer than three of the places agree. Where both maps are in
/// metres of known accuracy, that counts too. Cost: 0.2 ms a place and keyframe between the first and the
/// last one.
std::optional<MapAlignment> align_maps(const KeptMap& a, const KeptMap& b, std::vector<StatedPlace> places);

}  // namespace edgevo
