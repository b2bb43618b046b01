#pragma once
// Edge detectors behind one interface: each marks edge pixels in a mask; thinning, sub-pixel positions and
// linking are common to all (edge_extraction.h). A new one is a file in src/detectors/ and its lines in
// detector_list.* there.
#include <memory>
#include <string>
#include <vector>

#include "edgevo/edges/edge_params.h"
#include "edgevo/edges/gradient.h"

namespace edgevo {

/// Marks edge pixels. One object a thread.
class EdgeDetector {
 public:
  virtual ~EdgeDetector() = default;
  /// Mask of the image's size, nonzero at edge pixels (one or two pixels thick).
  virtual Plane<uint8_t> detect(const ImageView<uint8_t>& gray, const Gradient& gradient) = 0;
};

/// A detector that there is.
struct EdgeDetectorKind {
  const char* name;  ///< as edges.detector and --detector give it
  const char* what;  ///< in a few words, for --help
  std::unique_ptr<EdgeDetector> (*make)(const EdgeParams& params);  ///< never null
};

/// All of them, the default first.
const std::vector<EdgeDetectorKind>& edge_detector_kinds();
/// Their names: what edges.detector may be.
std::vector<std::string> edge_detector_names();
/// "canny (...), edge_drawing (...)".
std::string edge_detector_help();

/// The one that params.detector names. Throws InputError for an unknown name.
std::unique_ptr<EdgeDetector> make_edge_detector(const EdgeParams& params);

}  // namespace edgevo
