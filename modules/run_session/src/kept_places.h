// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The map of an earlier run that a run is placed in.
#include <memory>
#include <string>
#include <vector>

#include "edgevo/core/records.h"
#include "edgevo/map/map_graph.h"
#include "edgevo/places/place_store.h"

namespace edgevo {

/// A kept map for one run.
class KeptPlaces {
 public:
  /// Reads `path`, a map.db or the folder of a run. Throws InputError if it cannot be read, is of another
  /// camera than `pinhole`, is not finished, or if `scale` requests metres while the map has metres of its
  /// own.
  KeptPlaces(const std::string& path, const std::string& scale, const Pinhole& pinhole);

  /// Its places.
  std::shared_ptr<const PlaceStore> places() const { return places_; }
  /// What is damaged in the file, a line each.
  const std::vector<std::string>& warnings() const { return warnings_; }

  /// Whether the run was found in the map.
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
  bool is_metric_ = false;
  double scale_sigma_ = 0;
};

}  // namespace edgevo
