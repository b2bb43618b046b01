// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The edge detectors that a program offers, for the options of the odometry; the detectors are in
// edge_detector.h.
#include <memory>
#include <vector>

namespace edgevo {

class EdgeDetector;
class EdgeProbability;
struct EdgeParams;

/// A detector that a program offers.
struct EdgeDetectorKind {
  /// Name for edges.detector and --detector.
  const char* name;
  /// Short description for --help.
  const char* what;
  /// Factory of the detector; never null.
  std::unique_ptr<EdgeDetector> (*make)(const EdgeParams& params);
  /// Factory of the probability that it needs; null if none.
  std::unique_ptr<EdgeProbability> (*make_probability)(const EdgeParams& params) = nullptr;
};

/// The detectors that a program offers.
using EdgeDetectorTable = std::vector<EdgeDetectorKind>;

/// Table with Canny alone.
const EdgeDetectorTable& basic_edge_detectors();

}  // namespace edgevo
