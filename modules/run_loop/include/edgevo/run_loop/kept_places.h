// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The map of an earlier run that a run is placed in: PastParams::kept, and what follows from it.
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "edgevo/core/camera.h"
#include "edgevo/core/records.h"
#include "edgevo/map/map_event.h"
#include "edgevo/map/map_graph.h"
#include "edgevo/places/place_store.h"

namespace edgevo {

/// A kept map for one run.
class KeptPlaces {
 public:
  /// Reads `path`, a map.db or the folder of a run. Throws InputError if it cannot be read, is of another
  /// camera than `pinhole`, is not finished, or has metres of its own while the run gets some of `scale`, in
  /// the caller's words; empty: it gets none.
  KeptPlaces(const std::string& path, const Pinhole& pinhole, const std::string& scale);

  /// Its places.
  std::shared_ptr<const PlaceStore> places() const { return places_; }
  /// What is damaged in the file, a line each.
  const std::vector<std::string>& warnings() const { return warnings_; }
  /// Whether its lengths are metres.
  bool is_metric() const { return is_metric_; }

  /// Takes events of the run, in their order, while it goes on.
  void follow(const std::vector<std::shared_ptr<const MapEvent>>& events);
  /// Whether the events so far place the epoch in use in the frame and unit of this map: after a loss or a
  /// doubt not until the camera is found again.
  bool is_placed() const { return is_placed_; }

  /// Whether a finished run was found in the map.
  bool is_found(const Run& run) const;
  /// Gives metres to a run that was found in a map of metres.
  void give_unit(Run* run) const;
  /// Whether the run was found, in one line.
  std::string statement(const Run& run) const;
  /// Adds to the map's file what is new in `run_map`, the map of a run that was found: `found` from the map's
  /// keyframes to those of the run. Returns what was added, in one line. Throws InputError as write_map().
  std::string extend(const Run& run, const std::string& run_map, const std::vector<Constraint>& found) const;

 private:
  std::string path_;
  std::shared_ptr<const PlaceStore> places_;
  std::vector<std::string> warnings_;
  void follow(const MapEvent& event);
  void begin_epoch(int segment, int first_keyframe);
  bool is_found_since_then(int newest_constraint) const;

  std::map<int, int> found_;               // the constraints that say where the run is, and their keyframes
  int segment_ = -1, first_keyframe_ = 0;  // of the epoch in use
  bool is_metric_ = false, is_placed_ = false;
  double scale_sigma_ = 0;
};

}  // namespace edgevo
