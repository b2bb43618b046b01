// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The map that a run has kept, read back from its file (map.db): keyframes with their places, views and what
// relates them.
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "edgevo/core/camera.h"
#include "edgevo/map/map_graph.h"
#include "edgevo/places/place_store.h"

namespace edgevo {

/// What a map was made with.
struct MapHeader {
  /// Pinhole of the rectified images: that of all its views and points.
  Pinhole pinhole;
  /// The camera that took the images, in words.
  std::string camera;
  /// Source of the images, as `edgevo run` was given it.
  std::string source;
};

/// A camera in words: model, size, focal lengths, principal point, coefficients of the lens.
std::string camera_text(const Camera& camera);

/// A map.
struct KeptMap {
  /// Of nothing yet.
  explicit KeptMap(const MapHeader& made_with) : header(made_with), store(made_with.pinhole) {}

  /// What it was made with.
  MapHeader header;
  /// Whether the run came to its end. If so, the poses of all keyframes are in one world, after all loops;
  /// else each is in the map of its segment, in the unit of its epoch, as it left the window.
  bool is_finished = false;
  /// Source of the scale, as Run::scale_source; "none": the unit of length is arbitrary; else metres.
  std::string scale_source = "none";
  /// Relative standard deviation of the scale; 0: unknown.
  double scale_sigma = 0;
  /// What the run has found of the camera beyond its file; the pixels of all points are without it.
  ImageCorrection correction;
  /// The keyframes, by ascending id, each with its view.
  PlaceStore store;
  /// What relates keyframes besides the motion to the next one, which `store` has: without what turned out to
  /// be none, and without Constraint::failure. The unit is that of the poses.
  std::vector<Constraint> constraints;
  /// What is damaged or missing, a line each.
  std::vector<std::string> warnings;

  /// Whether lengths are metres.
  bool is_metric() const { return scale_source != "none"; }
};

/// Reads a map. Neither the file nor its folder is changed; of a file that a killed run has left, a copy is
/// read. Keyframes that are damaged are skipped, and `warnings` says so. Throws InputError: not there, not
/// such a file, of a newer version, or nothing whole in it. Cost: 0.4 ms a keyframe.
KeptMap read_map(const std::string& path);

/// Throws InputError that names `path`, the map's file, unless the map was made with images of this pinhole.
void check_camera(const KeptMap& map, const Pinhole& pinhole, const std::string& path);

/// The file of a map; `path`: the file, or the folder of a run.
std::string map_file_of(const std::string& path);

/// Reads a map as it lies in one world; `path` as in map_file_of(). Throws InputError as read_map(), and for
/// the map of a run that did not end.
KeptMap read_finished_map(const std::string& path);
/// The same of images of this pinhole, to place runs in: its places are of one epoch. Throws as
/// check_camera(), too.
KeptMap read_finished_map(const std::string& path, const Pinhole& pinhole);

/// What is in a map, as names and values: keyframes, points, bytes, extent, unit, light, ...
std::vector<std::pair<std::string, std::string>> describe(const KeptMap& map, const std::string& path);

/// Whether the path names a map: a file map.db, whatever is in it, or one that holds a map.
bool names_map(const std::string& path);

}  // namespace edgevo
