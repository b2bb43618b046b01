// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Follows what moves by itself through the images: a vehicle ahead, a bus that crosses. It is found where a
// group of points of the map contradicts the pose and agrees on a motion of its own
// (src/moving_group.h); from then on the body is followed by its edges, without map and depths, and
// what is on it takes no part in poses and map. So points that were made on it while it moved like the
// scene do no harm when it no longer does.
#include <memory>
#include <set>
#include <utility>
#include <vector>

#include "edgevo/alignment/alignment_params.h"
#include "edgevo/alignment/reference.h"
#include "edgevo/segmentation/group_motion.h"
#include "edgevo/segmentation/moving_areas.h"

namespace edgevo {

/// The moving bodies in view. For the thread that tracks.
///
/// A new one is on probation: it takes no part in poses, and nothing else. It counts once its motion since it
/// was found is one that a scene that stands still cannot have, and is given back if it is that of something
/// nearer than most of the scene, whose depth the map had wrong. A lorry that is followed looks like what is
/// far away for as long as the gap stays or closes evenly, so neither may be known for 60 frames. A body that
/// counts grows over what moves with it: it may have been found by a part, and in a turn its image is no
/// similarity of what it was.
class MovingObjects {
 public:
  /// Follows the known bodies into the next image; drops those that are no longer seen, or do not count after
  /// 60 frames. Cost: nothing without bodies, else 1 ms each.
  void follow(const FramePyramid& frame);
  /// Looks for a body that contradicts the pose of the newest frame. Returns true if there is a new one: the
  /// frame must be aligned again, without it.
  bool look(const FramePyramid& frame, const Reference& reference, const SE3& T_cur_ref,
            const AlignmentParams& params);
  /// Evaluates the bodies by the motion of the camera since the frame before. Returns the number of those
  /// that count from now on.
  int evaluate(const Pinhole& pinhole, const SE3& T_cur_last, double median_idepth);
  /// The reference without the points on bodies, as seen from about T_cur_ref; the same one if there are
  /// none, or if too few would remain to constrain a pose.
  std::shared_ptr<const Reference> without(std::shared_ptr<const Reference> reference, const Pinhole& pinhole,
                                           const SE3& T_cur_ref) const;
  /// The bodies in the newest frame that count.
  MovingAreas areas() const { return areas_of(false); }
  /// Forgets all bodies.
  void clear() { bodies_.clear(); }

 private:
  // An area along a side of a body: where it is, and its edges in the image before.
  struct Strip {
    ImageBox box;
    std::vector<OrientedPixel> before;
  };
  struct Body {
    ImageBox box;                          // by whose edges it is followed
    ImageBox area;                         // all of it, as far as is known; not less than the box
    std::set<std::pair<int, int>> points;  // of the map: host keyframe and edge pixel there
    std::vector<OrientedPixel> pixels;     // its edges in the newest image
    std::vector<OrientedPixel> around;     // those, and of what is next to it
    ImageSimilarity step;                  // since the image before
    std::vector<Strip> strips;             // next to it, that moved as it did
    int age = 0, unseen = 0;               // frames
    // Since it was found: for the evaluation.
    bool counts = false;
    std::vector<OrientedPixel> first_pixels;
    ImageSimilarity motion;
    SE3 T_cur_first;
  };
  static bool follow(const FramePyramid& frame, Body* body);
  static std::vector<OrientedPixel> followed_edges(const FramePyramid& frame, const Body& body);
  static Strip strip(const ImageBox& box, const Body& body);
  static void look_around(const FramePyramid& frame, Body* body);
  static void grow(const Pinhole& pinhole, const SE3& T_cur_last, double median_idepth, Body* body);
  MovingAreas areas_of(bool also_on_probation) const;
  static bool is_proved(const StaticComparison& c);
  static bool is_scene(const StaticComparison& c);

  std::vector<Body> bodies_;
};

}  // namespace edgevo
