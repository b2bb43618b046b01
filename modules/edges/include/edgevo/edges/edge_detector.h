// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Edge detectors behind one interface: each marks edge pixels in a mask; thinning, sub-pixel positions and
// linking are common to all (edge_extraction.h). A program passes a table of the detectors it offers to the
// pyramid builder: canny alone, which needs no further library, all detectors of edgevo
// (detectors/all_detectors.h), or a table with its own.
#include <memory>
#include <string>

#include "edgevo/edges/edge_detector_table.h"
#include "edgevo/edges/edge_params.h"
#include "edgevo/edges/edge_probability.h"
#include "edgevo/edges/gradient.h"

namespace edgevo {

/// Input of a detector: one level of a pyramid.
struct EdgeImage {
  /// Gray image of the level.
  ImageView<uint8_t> gray;
  /// Gradient of `gray`.
  const Gradient& gradient;
  /// Edge probability (edge_probability.h); empty for detectors that need none.
  ImageView<uint8_t> probability = {};
};

/// Marks edge pixels. Use one object per thread.
class EdgeDetector {
 public:
  virtual ~EdgeDetector() = default;
  /// Returns a mask of the size of the image, nonzero at edge pixels; edges are one or two pixels thick.
  virtual Plane<uint8_t> detect(const EdgeImage& image) = 0;
};

/// Help text of a table: "canny (...), edge_drawing (...)".
std::string edge_detector_help(const EdgeDetectorTable& table);

/// Makes the detector named by params.detector. Throws InputError for an unknown name and for one that is not
/// in the table.
std::unique_ptr<EdgeDetector> make_edge_detector(const EdgeParams& params,
                                                 const EdgeDetectorTable& table = basic_edge_detectors());

/// Makes the probability that params.detector needs; null for a detector that uses the gradient alone. Throws
/// InputError for an unknown name, one that is not in the table, and a model or folder that is missing or
/// damaged. Use one object per thread.
std::unique_ptr<EdgeProbability> make_edge_probability(
    const EdgeParams& params, const EdgeDetectorTable& table = basic_edge_detectors());

}  // namespace edgevo
