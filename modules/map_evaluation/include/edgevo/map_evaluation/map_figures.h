// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Completeness and rightness of the lines of a map against the rendered scene that it was made in.
//
// Both are measured in images, where a robot meets the map: every eighth frame is rendered anew, with exact
// depth, and the lines are projected into it.
//   complete  of the edge pixels that a plain Canny sees there, those with a line within two pixels and 5 %
//             of their depth
//   right     of the length of lines in view, what lies as near to an edge there, or in the frame that sees
//             it from nearest: far away, edges are too fine to be seen. What a nearer surface hides is
//             in nobody's view, and is wrong only if it is hidden in all frames
// Lines stay with their keyframe, which is put at its true pose, and one length ratio holds for the run: what
// the path is off is the matter of `edgevo eval TRAJECTORY`. Nothing here uses the code that makes lines.
#include <array>
#include <string>
#include <vector>

#include "edgevo/core/depth_source.h"
#include "edgevo/core/records.h"
#include "edgevo/simulation/scene_renderer.h"

namespace edgevo {

/// What to compare, and how closely.
struct MapEvaluationOptions {
  /// Every which frame is compared.
  int every = 8;
  /// Between an edge and a line, pixels.
  double within_px = 2;
  /// Difference of their depths, share.
  double depth_share = 0.05;
  /// Only the frames begin <= index < end; end -1: to the last keyframe of the map.
  int begin = 0, end = -1;
  /// Whether the causes of what is missing are counted, too, which takes a rendering of each frame.
  bool why = false;
};

/// Why an edge is missing, as far as the scene says.
enum class MissingCause {
  /// A line lies there, along it, at another depth.
  kWrongDepth,
  /// Fewer than four frames see it, from not much farther than the one compared.
  kFewFrames,
  /// A depth that is wrong moves it by less than a pixel in every frame: it is too far away for the path.
  kStill,
  /// A depth that is wrong moves it along itself, but less than a pixel across: views show it at any depth.
  kAlongMotion,
  /// Its edge is shorter than 12 pixels there.
  kShort,
  /// None of these: views show it, and no line was made of it, or kept.
  kNoLine
};
/// Number of causes.
constexpr int kMissingCauses = 6;
/// Name in tables.
const std::string& to_string(MissingCause cause);

/// Figures of the edges of one class.
struct MapFigure {
  /// The class: "all within 10 m", "outline", ...
  std::string name;
  /// Number of true edge pixels, and of those that a line explains.
  int64_t edges = 0, found = 0;
  /// Pixels of lines in view, and of those at an edge.
  int64_t drawn = 0, right = 0;

  /// Share of the edges that lines explain, 0 to 1; 0 without edges.
  double completeness() const { return edges > 0 ? double(found) / double(edges) : 0; }
  /// Share of the lines that lie at edges, 0 to 1; 0 without lines.
  double rightness() const { return drawn > 0 ? double(right) / double(drawn) : 0; }
  /// Harmonic mean of both; 0 if both are.
  double f() const;
};

/// Edges that are missing for one cause, the first one that holds in the order of MissingCause.
struct MissingFigure {
  /// Of all these.
  MissingCause cause;
  /// Number of edge pixels by Thing.
  std::array<int64_t, kThings> edges{};

  /// Number of edge pixels of all things.
  int64_t all() const;
};

/// A map compared with its scene.
struct MapFigures {
  /// Metres per unit of the map, by the positions of its keyframes.
  double metres_per_unit = 1;
  /// Number of frames compared.
  int frames = 0;
  /// Cumulative bands of the distance to the camera, nearest first; the last one has no limit.
  std::vector<MapFigure> bands;
  /// Within the band `near_m`: by kind of edge (outline, crease, texture), and by its direction in the image
  /// against the motion. Lines have no kind: what is drawn and right stays 0.
  std::vector<MapFigure> kinds;
  /// At all distances, the lines by what their depth is from (DepthSource, in its order). Edges have no
  /// source.
  std::vector<MapFigure> sources;
  /// Within `near_m`, edges and lines by where they are: on the ground, upright above it, and all others.
  std::vector<MapFigure> places;
  /// Within `near_m`, by what the edges belong to (Thing, in its order): lines know of none.
  std::vector<MapFigure> classes;
  /// Within `near_m`, why edges are missing (MissingCause, in its order); empty unless requested.
  std::vector<MissingFigure> causes;
  /// Depth up to which kinds, places, classes and causes are counted, metres.
  double near_m = 0;

  /// Whether less than half of the lines lie at edges: those of the poorest map of its own scene do.
  bool is_of_another_scene() const;
};

/// Compares the lines of `map`, which has the frame indices of the scene, with the scene. Throws InputError
/// if fewer than three of its keyframes are frames of the scene, or if they do not move. Cost: four
/// renderings a frame compared; with `why`, one more of each frame.
MapFigures evaluate_map(const Run& map, const SceneRenderer& scene, const MapEvaluationOptions& options = {});

/// PNG of frame `index`, darkened: edges that lines explain green, the others red; lines in view that lie at
/// no edge blue. Throws InputError as evaluate_map() does, or if there is no such frame.
std::string map_picture_png(const Run& map, const SceneRenderer& scene, int index,
                            const MapEvaluationOptions& options = {});

/// The figures as aligned text.
std::string to_table(const MapFigures& figures);
/// The figures as JSON.
std::string to_json(const MapFigures& figures);

}  // namespace edgevo
