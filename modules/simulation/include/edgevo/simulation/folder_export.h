// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Writes rendered frames as a folder in the `edgevo` layout, which every reader of this project knows:
//
//   images/000000.png ..     8-bit gray, numbered as in the scene
//   times.txt                seconds, one line an image
//   camera.txt               fx fy cx cy k1 k2 p1 p2 width height k3, or the text that is given, which is
//                            needed for a lens that this line cannot hold
//   groundtruth_tum.txt      t tx ty tz qx qy qz qw: T_world_cam in metres, the first camera written is the
//                            identity
//   depth/000000.pfm ..      on demand: z in metres as 32-bit floats (PFM, rows from the bottom up), 0 for
//                            sky, at the pixels of the undistorted image
//   edges/000000.png ..      on demand: true edges and their kinds, see true_edge_labels.h
//   masks/000000.png ..      of scenes with traffic: 255, or the number of the body that is seen (0, 1, ..)
//   mask.png                 with an own part: 0 where it is seen, else 255
//   SOURCE.md                what it is and how to make it again
#include <functional>
#include <string>

#include "edgevo/core/gyro_sample.h"
#include "edgevo/simulation/overlay.h"
#include "edgevo/simulation/scene_renderer.h"

namespace edgevo {

/// Options of export_folder().
struct FolderExport {
  /// Range of frames, begin <= index < end; end -1: to the last.
  int begin = 0, end = -1;
  /// True: also write the depth of each frame.
  bool depth = false;
  /// True: also write true edges as label images (true_edge_labels.h).
  bool edges = false;
  /// Number of threads; does not affect the bytes written.
  int threads = 2;
  /// Text of camera.txt; empty: one line of numbers.
  std::string camera_text = {};
  /// Part that is fixed to the camera, pasted over the images; depth and edges remain those of the scene.
  std::shared_ptr<const Overlay> own_part = {};
};

/// Removes what an earlier call wrote to the folder, so that it never holds images of two sequences. Folders
/// without such a sequence (its SOURCE.md) are left alone.
void clear_sequence(const std::string& folder);

/// Writes any source in the same layout, frame by frame. Depth and poses are not known here; see finish().
class FolderWriter {
 public:
  /// Creates the folders. `camera_text` as in FolderExport. Throws InputError.
  FolderWriter(std::string folder, const Camera& camera, const std::string& camera_text = {});
  /// Writes the image under its name in the source, or the frame's number if it has none. Throws InputError,
  /// also if the names are not in the order of the frames: the folder would play in a different order.
  void add(const Frame& frame);
  /// Writes masks/NAME.png: 255 where `frame`, the one added last, shows the scene, 0 where something that
  /// moves by itself hides it. Throws InputError.
  void add_mask(const Frame& frame, const GrayImage& mask);
  /// Writes mask.png: 255 where the scene is seen, 0 on parts that are fixed to the camera. Throws
  /// InputError.
  void add_fixed_mask(const GrayImage& mask);
  /// Writes imu.txt, unless there are no samples. Throws InputError.
  void add_gyro(const GyroReadings& readings);
  /// Writes the lists; `ground_truth` is the text of groundtruth_tum.txt (empty: no such file), `source_note`
  /// that of SOURCE.md. Throws InputError.
  void finish(const std::string& ground_truth, const std::string& source_note);

 private:
  std::string folder_, camera_text_, times_, last_name_;
};

/// Text of groundtruth_tum.txt for the frames begin <= index < end, which must exist.
std::string ground_truth_tum(const SceneRenderer& renderer, int begin, int end);

/// Called with the number of frames done, one call at a time.
using OnFrameDone = std::function<void(int)>;

/// Writes the frames. Existing files of these names are overwritten. Throws InputError: no frame in the
/// range, a lens without a text, something cannot be written.
void export_folder(const SceneRenderer& renderer, const std::string& folder, const FolderExport& options,
                   const OnFrameDone& on_frame_done = {});

}  // namespace edgevo
