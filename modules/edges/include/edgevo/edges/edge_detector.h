#pragma once
// Edge detectors behind one interface: each marks edge pixels in a mask; thinning, sub-pixel positions and
// linking are common to all (edge_extraction.h). What a program offers is a table that it hands to the
// pyramid builder: canny alone, which needs no further library, or all of edgevo (detectors/all_detectors.h),
// or with one of its own.
#include <memory>
#include <string>
#include <vector>

#include "edgevo/edges/edge_params.h"
#include "edgevo/edges/edge_probability.h"
#include "edgevo/edges/gradient.h"

namespace edgevo {

/// One level of a pyramid, as detectors see it.
struct EdgeImage {
  ImageView<uint8_t> gray;   ///< of this level
  const Gradient& gradient;  ///< of `gray`
  ImageView<uint8_t> probability =
      {};  ///< of an edge (edge_probability.h); without data for detectors that need none
};

/// Marks edge pixels. One object a thread.
class EdgeDetector {
 public:
  virtual ~EdgeDetector() = default;
  /// Mask of the image's size, nonzero at edge pixels (one or two pixels thick).
  virtual Plane<uint8_t> detect(const EdgeImage& image) = 0;
};

/// A detector that a program offers.
struct EdgeDetectorKind {
  const char* name;  ///< as edges.detector and --detector give it
  const char* what;  ///< in a few words, for --help
  std::unique_ptr<EdgeDetector> (*make)(const EdgeParams& params);  ///< never null
  std::unique_ptr<EdgeProbability> (*make_probability)(const EdgeParams& params) =
      nullptr;  ///< null: it needs none
};

/// The detectors that a program offers.
using EdgeDetectorTable = std::vector<EdgeDetectorKind>;

/// Canny alone.
const EdgeDetectorTable& basic_edge_detectors();

/// "canny (...), edge_drawing (...)".
std::string edge_detector_help(const EdgeDetectorTable& table);

/// The one that params.detector names. Throws InputError for an unknown name, and for one that is not in the
/// table.
std::unique_ptr<EdgeDetector> make_edge_detector(const EdgeParams& params,
                                                 const EdgeDetectorTable& table = basic_edge_detectors());

/// The probability that params.detector rests on; null for a detector that looks at the gradient alone.
/// Throws InputError as make_edge_detector, and for a model or a folder that is missing or damaged. One
/// object a thread.
std::unique_ptr<EdgeProbability> make_edge_probability(
    const EdgeParams& params, const EdgeDetectorTable& table = basic_edge_detectors());

}  // namespace edgevo
