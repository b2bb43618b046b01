#pragma once
// A frame made ready for tracking and mapping: undistorted image pyramid, and on its finest levels edges with
// their nearest-neighbour fields.
#include <memory>
#include <vector>

#include "edgevo/core/camera.h"
#include "edgevo/core/image.h"
#include "edgevo/edges/edge_detector.h"
#include "edgevo/edges/edge_map.h"
#include "edgevo/edges/image_correction.h"
#include "edgevo/edges/nearest_field.h"
#include "edgevo/edges/plane.h"

namespace edgevo {

/// x_l = x_0 / 2^l for all pixel coordinates.
struct PyramidLevel {
  Pinhole pinhole;                  ///< of this level's pixels
  Plane<uint8_t> gray;              ///< undistorted
  Plane<float> gradient_magnitude;  ///< Sobel units; empty on levels without edges
  EdgeMap edges;                    ///< empty on levels without edges
  NearestField field;               ///< of `edges`; empty on levels without edges
};

/// A frame made ready. Immutable once it is built.
struct FramePyramid {
  std::vector<PyramidLevel> levels;  ///< the finest first
  GrayImage source;  ///< as the camera took it: to build the pyramid again when the camera is corrected
  std::shared_ptr<const Plane<uint8_t>>
      border_mask;  ///< 255 where no light reaches `source`: no edges are taken there; null where it does
                    ///< everywhere, and at first
  std::shared_ptr<const Plane<uint8_t>>
      probability;  ///< of an edge, of `source` (edge_probability.h); null for a detector that needs none
  ImageCorrection correction;  ///< that was taken out of `levels`, beside what the camera file says
  const PyramidLevel& finest() const { return levels.front(); }  ///< level 0
  double masked_share() const;                                   ///< of the pixels of `source`, 0 to 1
};

/// Turns frames into pyramids. Holds the detector and the undistortion maps; one object a thread.
class PyramidBuilder {
 public:
  /// Throws InputError for an unknown detector or one that `detectors` lacks, a model or folder that it
  /// cannot use, or an unusable camera.
  PyramidBuilder(const Camera& camera, const EdgeParams& params,
                 const EdgeDetectorTable& detectors = basic_edge_detectors());
  ~PyramidBuilder();
  PyramidBuilder(PyramidBuilder&&) noexcept;
  /// One that is asked to rebuild() only, which takes no model: the probability is in the pyramid.
  static PyramidBuilder for_rebuilding(const Camera& camera, const EdgeParams& params,
                                       const EdgeDetectorTable& detectors = basic_edge_detectors());

  /// Pinhole of the undistorted images.
  const Pinhole& pinhole() const;
  /// Taken out of the images that follow. A change of k1 makes new undistortion maps, about 20 ms at
  /// 1241x376.
  ImageCorrection correction() const;
  /// likewise; pyramids built before stay as they are
  void set_correction(const ImageCorrection& correction);
  /// `image` must have the camera's size (throws InputError). `motion`: of the image at that moment, for a
  /// rolling shutter; without it the rows stay where they are. Cost at 1241x376: see
  /// tests/bench/bench_edges.cpp. Images of one camera in their order: what no image so far has lit (a black
  /// frame, a letterbox) gets no edges.
  std::shared_ptr<const FramePyramid> build(const GrayImage& image, const ImageMotion& motion = {});
  /// The same for a frame, by whose name the detector `precomputed` finds its files; throws InputError where
  /// it does not.
  std::shared_ptr<const FramePyramid> build(const Frame& frame, const ImageMotion& motion = {});
  /// The pyramid of the same image for the present correction and another motion.
  std::shared_ptr<const FramePyramid> rebuild(const FramePyramid& old, const ImageMotion& motion = {});

 private:
  PyramidBuilder(const Camera& camera, const EdgeParams& params, std::unique_ptr<EdgeDetector> detector,
                 std::unique_ptr<EdgeProbability> probability);
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace edgevo
