#pragma once
// Renders the frames of a scene, with exact depth and pose.
//
// A software renderer of its own, measured against MRPT's off-screen OpenGL (see
// share/lab/archive/2026-11-21_own_renderer.md): it filters textures, gives
// the same bytes on every machine, samples through the lens distortion itself instead of warping an image,
// and is as fast.
//
// How: for each surface, 1/z and the texture coordinates over z are linear functions of the viewing ray (x,
// y, 1). Every pixel is looked through at nine points on a lattice; a depth buffer of one row finds the
// nearest surface at each; a pixel whose nine points meet one surface is shaded once, others once for each
// surface. Textures are filtered along the longer axis of the pixel's footprint. A shutter that is open for a
// while looks at several instants along the true motion, a rolling shutter at each row from its own pose.
// Pixel (0,0) is the centre of the top-left pixel, as everywhere here.
#include <vector>

#include "edgevo/core/image.h"
#include "edgevo/core/se3.h"
#include "edgevo/simulation/scene.h"

namespace edgevo {

/// A frame with its ground truth.
struct RenderedFrame {
  int index = 0;    ///< in the scene
  Timestamp time;   ///< from 0 s on
  GrayImage image;  ///< as the camera takes it: distorted if its lens is, with its shutter and noise
  std::vector<float>
      depth;        ///< z in metres at the pixel centres of the UNDISTORTED image, row by row; 0: sky
  SE3 T_world_cam;  ///< world: the axes and origin of the scene's first camera. Pose and depth are those at
                    ///< `time`, the middle of the exposure of the middle of the image
};

/// Renders one scene. Any number of threads.
class SceneRenderer {
 public:
  /// Throws InputError for a shutter that does not fit the times of the frames.
  explicit SceneRenderer(Scene scene);

  const Camera& camera() const { return scene_.camera; }  ///< of the scene
  int size() const { return scene_.size(); }              ///< number of frames
  const Scene& scene() const { return scene_; }           ///< as given

  /// Frame `index`, 0 <= index < size(). The frames do not depend on each other; any order, any thread.
  RenderedFrame render(int index) const;
  /// Only the image.
  GrayImage render_image(int index) const;
  /// Only the depth.
  std::vector<float> render_depth(int index) const;
  /// The same from any pose, for a camera that is steered: a shutter of no duration; `index` is the number
  /// that the noise follows.
  GrayImage render_image_from(const SE3& T_scene_cam, int index) const;
  std::vector<float> render_depth_from(const SE3& T_scene_cam) const;  ///< as render_depth()
  /// Ground truth of a frame in the first camera's axes.
  SE3 T_world_cam(int index) const;

 private:
  Scene scene_;
  std::vector<Eigen::Vector2f>
      rays_;  ///< of every sample point through a distorting lens; empty for a pinhole
};

}  // namespace edgevo
