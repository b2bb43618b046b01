#pragma once
// Writes rendered frames as a folder in the `edgevo` layout, which every reader of this project knows:
//
//   images/000000.png ..     8-bit gray, numbered as in the scene
//   times.txt                seconds, one line an image
//   camera.txt               fx fy cx cy k1 k2 p1 p2 width height k3
//   groundtruth_tum.txt      t tx ty tz qx qy qz qw: T_world_cam in metres, the first camera written is the identity
//   depth/000000.pfm ..      on demand: z in metres as 32-bit floats (PFM, rows from the bottom up), 0 for sky, at the
//                            pixels of the undistorted image
//   SOURCE.md                what it is and how to make it again
#include <functional>
#include <string>

#include "edgevo/simulation/scene_renderer.h"

namespace edgevo {

/// What is written.
struct FolderExport {
  int begin = 0, end = -1;  ///< frames begin <= index < end; end -1: to the last
  bool depth = false;  ///< the depth of each frame, too
  int threads = 2;          ///< the bytes do not depend on it
};

/// Takes away what an earlier call wrote into the folder: images of two sequences in one would be none.
/// Folders that do not hold such a sequence (its SOURCE.md) are left alone.
void clear_sequence(const std::string& folder);

/// The same layout from any source, frame by frame. Depth and poses are not known here; see finish().
class FolderWriter {
 public:
  /// Makes the folders. Throws InputError.
  FolderWriter(std::string folder, const Camera& camera);
  /// Writes the image under its name in its source, or the frame's number if it has none. Throws InputError, also when the names of the
  /// source are not in the order of its frames: the folder would play in another order.
  void add(const Frame& frame);
  /// Writes the lists; `ground_truth` is the text of groundtruth_tum.txt (empty: no such file), `source_note` that of
  /// SOURCE.md. Throws InputError.
  void finish(const std::string& ground_truth, const std::string& source_note);

 private:
  std::string folder_, times_, last_name_;
  Camera camera_;
};

/// Text of groundtruth_tum.txt for frames begin <= index < end, which exist.
std::string ground_truth_tum(const SceneRenderer& renderer, int begin, int end);

/// Called with the number of frames done, one call at a time.
using OnFrameDone = std::function<void(int)>;

/// Throws InputError: no frame in the range, something cannot be written. Existing files of these names are overwritten.
void export_folder(const SceneRenderer& renderer, const std::string& folder, const FolderExport& options,
                   const OnFrameDone& on_frame_done = {});

}  // namespace edgevo
