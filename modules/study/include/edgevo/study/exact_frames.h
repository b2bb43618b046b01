#pragma once
// Frames whose depth and pose are exact: what the study measures against. Rendered in memory, or read from Virtual KITTI.
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
  int index = 0;  ///< in the sequence
  double seconds = 0;        ///< since the first frame
  GrayImage image;           ///< as the camera took it
  std::vector<float> depth;  ///< z in metres at the pixels of the undistorted image, row by row; 0: sky
  SE3 T_world_cam;           ///< metres
};

/// A sequence of such frames.
class ExactFrames {
 public:
  virtual ~ExactFrames() = default;
  /// of all frames
  virtual const Camera& camera() const = 0;
  /// number of frames
  virtual int size() const = 0;
  /// What it is, for the report.
  virtual std::string name() const = 0;
  /// Pose of a frame without loading it.
  virtual SE3 T_world_cam(int index) const = 0;
  /// 0 <= index < size(). May be called from several threads. Throws InputError for a file that cannot be read.
  virtual ExactFrame load(int index) const = 0;
};

/// A scene by name or file (simulation/scene.h). Throws InputError, also for a rolling shutter.
std::unique_ptr<ExactFrames> rendered_frames(const std::string& name);

/// A Virtual KITTI sequence (datasets/virtual_kitti.h). Throws InputError, also where its poses are missing.
std::unique_ptr<ExactFrames> virtual_kitti_frames(const SourceOptions& options);

}  // namespace edgevo
