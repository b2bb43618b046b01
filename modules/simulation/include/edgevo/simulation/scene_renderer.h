// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Renders the frames of a scene, with exact depth and pose.
//
// A software renderer of its own, measured against MRPT's off-screen OpenGL (see
// lab 2026-11-21_own_renderer): it filters textures, gives the same bytes on every machine,
// samples directly through the lens distortion instead of warping an image, and is as fast.
//
// A fisheye looks through the faces of a cube, each with rays (x, y, 1) of its own.
//
// How: for each surface, 1/z and the texture coordinates over z are linear functions of the viewing ray (x,
// y, 1). Every pixel is sampled at nine points on a lattice; a depth buffer of one row finds the nearest
// surface at each; a pixel whose nine points meet one surface is shaded once, others once for each surface.
// Textures are filtered along the longer axis of the pixel's footprint. A finite exposure is sampled at
// several instants along the true motion, and a rolling shutter renders each row from its own pose. Pixel
// (0,0) is the centre of the top-left pixel, as everywhere here.
#include <functional>
#include <memory>
#include <vector>

#include "edgevo/core/image.h"
#include "edgevo/core/se3.h"
#include "edgevo/simulation/scene.h"

namespace edgevo {

struct LensRays;
struct ViewSurface;

/// A frame with its ground truth.
struct RenderedFrame {
  /// Index in the scene.
  int index = 0;
  /// Time, from 0 s.
  Timestamp time;
  /// Image as taken by the camera: with its lens distortion, shutter and noise.
  GrayImage image;
  /// Depth z in metres at the pixel centres of the UNDISTORTED image (SceneRenderer::undistorted()), row by
  /// row; 0: sky.
  std::vector<float> depth;
  /// Pose; the world has the axes and origin of the scene's first camera. Pose and depth are those at `time`,
  /// the middle of the exposure of the middle of the image.
  SE3 T_world_cam;
};

/// In render_things(): the sky.
constexpr uint8_t kNoThing = 255;

/// Renders one scene. Any number of threads.
class SceneRenderer {
 public:
  /// Throws InputError for a shutter that does not fit the times of the frames.
  explicit SceneRenderer(Scene scene);

  /// Camera of the scene.
  const Camera& camera() const { return scene_.camera; }
  /// Pinhole of the undistorted images, in which depth and true edges are given: that to which the odometry
  /// rectifies the images.
  Pinhole undistorted() const;
  /// Number of frames.
  int size() const { return scene_.size(); }
  /// The scene.
  const Scene& scene() const { return scene_; }

  /// Frame `index`, 0 <= index < size(). Frames are independent; any order, any thread.
  RenderedFrame render(int index) const;
  /// Image of frame `index`.
  GrayImage render_image(int index) const;
  /// Depth of frame `index`.
  std::vector<float> render_depth(int index) const;
  /// Image from any pose, with an instantaneous shutter, for a controlled camera; `index` selects the noise,
  /// and bodies are where they are in that frame, or the last one.
  GrayImage render_image_from(const SE3& T_scene_cam, int index) const;
  /// Which body of the scene each pixel of frame `index` shows, in the middle of the exposure of its row:
  /// its number, 99 at most, or 255 where none is seen.
  GrayImage render_bodies(int index) const;
  /// What each pixel centre of the undistorted image of frame `index` shows: Thing, or kNoThing for the sky;
  /// bodies are objects.
  GrayImage render_things(int index) const;
  /// Depth of the world from any pose, as in render_depth() but without bodies.
  std::vector<float> render_depth_from(const SE3& T_scene_cam) const;
  /// Ground truth of a frame in the first camera's axes.
  SE3 T_world_cam(int index) const;

 private:
  std::vector<float> depth_of(const std::vector<ViewSurface>& views) const;
  /// Calls `see` with the surface that each pixel centre of the undistorted image meets, row by row, or null.
  void each_pixel(
      const std::vector<ViewSurface>& views,
      const std::function<void(const ViewSurface* surface, const Eigen::Vector2d& px)>& see) const;

  Scene scene_;
  /// Rays of all sample points.
  std::shared_ptr<const LensRays> rays_;
};

}  // namespace edgevo
