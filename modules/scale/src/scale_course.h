// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The scale along a run from all its sources: one graph (map/map_graph.h).
//
// Nodes are knots along the paths, every half interval, with a logarithm of the scale each. Neighbours are
// linked by how little the scale of the odometry drifts. Each source measures the scale of the interval
// around each knot. Intervals share half their samples with the next: their variances are multiplied by how
// often a sample is counted. What all measurements of a source have in common, such as the camera's height,
// is a node of its own. Any of them can fail; wheels that slip go on doing so, which is cheaper than to slip
// anew.
#include <optional>
#include <vector>

#include "edgevo/scale/path.h"
#include "edgevo/scale/scale_estimate.h"
#include "edgevo/scale/scale_params.h"
#include "source_samples.h"

namespace edgevo {

/// A path in one unit, and what was measured along it.
struct MeasuredPath {
  const Path* path = nullptr;
  /// The same sources in each path.
  std::vector<SourceSamples> sources;
  /// Standard deviation of the logarithm of its unit over that of the path before; nullopt: nothing links
  /// them.
  std::optional<double> link_sigma;
};

/// What a source measured over the interval around one knot.
struct IntervalMeasurement {
  /// Position of the path and of the source.
  size_t path = 0, source = 0;
  /// Travelled distances of the interval, and of the part of it that is nearer to its knot than to others.
  double begin = 0, end = 0, zone_begin = 0, zone_end = 0;
  IntervalFit fit;
  /// Whether it agrees with the rest; if not it does not count.
  bool holds = true;
  /// Logarithm of its factor over that of the knot, and the standard deviation of the difference.
  double log_excess = 0, log_excess_sigma = 0;
};

/// The scale along a run.
struct ScaleCourse {
  /// One estimate for each pose of each path; samples == 0: no source measured there. Empty: nowhere.
  std::vector<std::vector<ScaleEstimate>> of_path;
  /// By path, distance and source.
  std::vector<IntervalMeasurement> measurements;
};

/// Which constraints hold and which have failed.
enum class CourseModes {
  kOfGraph,  ///< As the graph finds, which begins at the guess.
  kOfGuess   ///< As the guess says, the least cost where each knot takes a value that was measured near it: a
             ///< tenth of the time.
};

/// Cost: two fits for each interval and source, and the solution of the graph, which is linear in the length
/// of the run. With kOfGuess IntervalMeasurement::holds is set for wheels
/// alone.
ScaleCourse solve_scale_course(const std::vector<MeasuredPath>& paths, const ScaleParams& params,
                               CourseModes modes = CourseModes::kOfGraph);

}  // namespace edgevo
