// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Frames with exact depth and pose, the reference of the study. Rendered in memory, or read from Virtual
// KITTI.
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "edgevo/core/camera.h"
#include "edgevo/core/image.h"
#include "edgevo/core/se3.h"
#include "edgevo/datasets/open_source.h"

namespace edgevo {

/// A frame with its ground truth.
struct ExactFrame {
  /// Index in the sequence.
  int index = 0;
  /// Time since the first frame.
  double seconds = 0;
  /// Image as taken by the camera.
  GrayImage image;
  /// Depth z in metres at the pixels of the undistorted image, row by row; 0: sky.
  std::vector<float> depth;
  /// Pose, metres.
  SE3 T_world_cam;
};

/// A sequence of frames with exact depth and pose.
class ExactFrames {
 public:
  virtual ~ExactFrames() = default;
  /// Camera of all frames.
  virtual const Camera& camera() const = 0;
  /// Number of frames.
  virtual int size() const = 0;
  /// Name for the report.
  virtual std::string name() const = 0;
  /// Pose of a frame, without loading it.
  virtual SE3 T_world_cam(int index) const = 0;
  /// Loads a frame, 0 <= index < size(). May be called from several threads. Throws InputError for a file
  /// that cannot be read.
  virtual ExactFrame load(int index) const = 0;
};

/// Frames of a scene by name or file (simulation/scene.h). Throws InputError, also for a rolling shutter.
std::unique_ptr<ExactFrames> rendered_frames(const std::string& name);

/// Frames of a Virtual KITTI sequence (datasets/virtual_kitti.h). Throws InputError, also if its poses are
/// missing.
std::unique_ptr<ExactFrames> virtual_kitti_frames(const SourceOptions& options);

}  // namespace edgevo
