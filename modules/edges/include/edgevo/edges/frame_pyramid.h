// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A frame prepared for tracking and mapping: rectified image pyramid, with edges and their
// nearest-neighbour fields on its finest levels.
#include <memory>
#include <vector>

#include "edgevo/core/camera.h"
#include "edgevo/core/image.h"
#include "edgevo/core/rectification.h"
#include "edgevo/edges/edge_detector.h"
#include "edgevo/edges/exposure_check.h"
#include "edgevo/edges/image_correction.h"
#include "edgevo/edges/image_edges.h"
#include "edgevo/edges/nearest_field.h"
#include "edgevo/edges/plane.h"
#include "edgevo/edges/view_observer.h"

namespace edgevo {

/// One level of a pyramid; pixel coordinates are x_l = x_0 / 2^l.
struct PyramidLevel {
  /// Pinhole of this level's pixels.
  Pinhole pinhole;
  /// Rectified gray image; of `deep`, rounded, if there is one.
  Plane<uint8_t> gray;
  /// Rectified gray image of more than 8 bits (deep_gray.h), from which edges and patches are taken; empty
  /// for 8 bits. Images that use little of the scale of their sequence are spread.
  Plane<uint16_t> deep;
  /// Gradient magnitude, Sobel units; empty on levels without edges.
  Plane<float> gradient_magnitude;
  /// Edges of the level, none near pixels without a source; empty on levels without edges.
  ImageEdges edges;
  /// Nearest-neighbour field of `edges`; empty on levels without edges.
  NearestField field;

  /// Calls `f` with a view of the gray image in full depth, ImageView<uint16_t> or ImageView<uint8_t>, and
  /// returns its result.
  template <class F>
  auto with_gray(const F& f) const {
    return deep.empty() ? f(gray.view()) : f(deep.view());
  }
};

/// Pyramid of a frame. Immutable once it is built.
struct FramePyramid {
  /// Levels, finest first.
  std::vector<PyramidLevel> levels;
  /// Raw image, kept to rebuild the pyramid when the camera is corrected.
  GrayImage source;
  /// Mask of `source`, 255 where no light ever reaches it, so that no edges are extracted; null if there is
  /// no such area.
  std::shared_ptr<const Plane<uint8_t>> border_mask;
  /// Mask of `source`, 255 on parts that are fixed to the camera, given or found, so that no edges are
  /// extracted; null if there are none.
  std::shared_ptr<const Plane<uint8_t>> ego_mask;
  /// The same in the finest level; empty if there are none.
  Plane<uint8_t> ego_area;
  /// Whether rows of `source` are of the image before: `ego_area` covers them, too.
  bool is_torn = false;
  /// Edge probability of `source` (edge_probability.h); null for a detector that needs none.
  std::shared_ptr<const Plane<uint8_t>> probability;
  /// Correction applied to `levels` in addition to the camera file.
  ImageCorrection correction;
  /// Finest level (level 0).
  const PyramidLevel& finest() const { return levels.front(); }
  /// Share of the pixels of `source` covered by `border_mask`, 0 to 1.
  double masked_share() const;
  /// Share of the pixels of `source` covered by `ego_mask`, 0 to 1.
  double ego_share() const;
  /// Whether a pixel of the finest level, inside the image, lies on a part that is fixed to the camera.
  bool is_ego(double x, double y) const {
    return !ego_area.empty() && ego_area.at(int(x + 0.5), int(y + 0.5)) != 0;
  }
};

/// Builds pyramids from frames. Holds the detector and the undistortion maps; use one object per thread.
class PyramidBuilder {
 public:
  /// Throws InputError for an unknown detector, one that is not in `detectors`, an unusable model or folder,
  /// or an unusable camera.
  PyramidBuilder(const Rectification& rectification, const EdgeParams& params,
                 const EdgeDetectorTable& detectors = basic_edge_detectors());
  ~PyramidBuilder();
  PyramidBuilder(PyramidBuilder&&) noexcept;
  /// Builder for rebuild() only. It loads no model, since the pyramid holds the probability.
  static PyramidBuilder for_rebuilding(const Rectification& rectification, const EdgeParams& params,
                                       const EdgeDetectorTable& detectors = basic_edge_detectors());

  /// Pinhole of the pyramids: the target of the rectification.
  const Pinhole& pinhole() const;
  /// Correction applied to new images.
  ImageCorrection correction() const;
  /// Sets the correction for new images; existing pyramids do not change. A change of k1 makes new
  /// undistortion maps, about 20 ms at 1241x376.
  void set_correction(const ImageCorrection& correction);
  /// Sets that of another builder for the same camera, whose maps are shared.
  void share_correction(const PyramidBuilder& other);
  /// Builds the pyramid of a raw image. Throws InputError if it does not have the size of the camera.
  /// `motion` is the image motion at that time, used to rectify a rolling shutter; without it the rows stay
  /// unchanged. `observer` gives the masks of the image, and sees its edges; null: nothing is masked. Cost:
  /// tests/bench/bench_edges.cpp.
  std::shared_ptr<const FramePyramid> build(const GrayImage& image, const ImageMotion& motion = {},
                                            ViewObserver* observer = nullptr);
  /// Sets the rows of the next raw image that are not its own (exposure_check.h), for that image only.
  void set_old_rows(const ImageRows& rows);
  /// Builds the pyramid of a frame, whose name the detector `precomputed` uses to find its files; throws
  /// InputError if there is none.
  std::shared_ptr<const FramePyramid> build(const Frame& frame, const ImageMotion& motion = {},
                                            ViewObserver* observer = nullptr);
  /// Rebuilds the pyramid of the same image, with its masks, the present correction and another motion.
  std::shared_ptr<const FramePyramid> rebuild(const FramePyramid& old, const ImageMotion& motion = {});
  /// The same with other masks, those of a later image.
  std::shared_ptr<const FramePyramid> rebuild(const FramePyramid& old, const ImageMotion& motion,
                                              const ImageMasks& masks);

 private:
  PyramidBuilder(const Rectification& rectification, const EdgeParams& params,
                 std::unique_ptr<EdgeDetector> detector, std::unique_ptr<EdgeProbability> probability);
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace edgevo
