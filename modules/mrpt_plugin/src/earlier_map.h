// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The map of an earlier run that a recording is placed in.
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "edgevo/core/camera.h"
#include "edgevo/map/map_log.h"
#include "edgevo/places/place_store.h"

namespace edgevo {

class EarlierMap {
 public:
  /// Reads `path`, a map.db or the folder of a run. Throws InputError if it cannot be read, is of another
  /// camera than `pinhole`, is not finished, or has metres of its own while `metres_per_unit` is not 0.
  EarlierMap(const std::string& path, const Pinhole& pinhole, double metres_per_unit);

  /// Its places.
  std::shared_ptr<const PlaceStore> places() const { return places_; }
  /// What is damaged in the file, a line each.
  const std::vector<std::string>& warnings() const { return warnings_; }
  /// Whether its lengths are metres.
  bool is_metric() const { return is_metric_; }

  /// Call after each frame. True once: when poses in `map` are in the frame and unit of this map.
  bool is_placed_by(const std::vector<std::shared_ptr<const MapEvent>>& events);

 private:
  std::shared_ptr<const PlaceStore> places_;
  std::vector<std::string> warnings_;
  std::set<int> found_;  // the constraints that say so
  bool is_metric_ = false, is_placed_ = false;
};

}  // namespace edgevo
