// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Writes the edge probability of every image of a source to files, for the detector `precomputed`, on this or
// another machine.
//
//   FOLDER/NAME.png           8 bits, 0 to 255, for the image NAME.* of the source, or the frame of that
//                             number (000012)
//   FOLDER/edges.yaml         the settings: images of other settings are not added to the folder
//   FOLDER/contact_sheet.jpg  some frames with their edges, next to their probabilities
#include <functional>
#include <string>

#include "edgevo/core/image_source.h"
#include "edgevo/edges/edge_params.h"

namespace edgevo {

/// Options of write_edge_images().
struct EdgeImageOptions {
  /// Detector; for one that uses the gradient alone, its edge pixels are written (0 or 255).
  EdgeParams edges;
  /// Output folder.
  std::string folder;
  /// Source as named by the user, for edges.yaml.
  std::string source_path;
  /// Number of threads; the files do not depend on it.
  int threads = 1;
  /// Whether the folder may contain other files.
  bool force = false;
  /// Called with the number of frames so far, never concurrently.
  std::function<void(int)> on_frame_done;
  /// Checked before each frame; true stops the work.
  std::function<bool()> stop;
};

/// Numbers of images of the source, by outcome.
struct EdgeImageCounts {
  /// New files.
  int written = 0;
  /// Files that existed already.
  int kept = 0;
  /// Images that could not be used.
  int skipped = 0;
  /// All images of the source.
  int all() const { return written + kept + skipped; }
};

/// Processes `source` to its end. Existing files are kept and new files are written atomically, so that a
/// second call resumes an interrupted one. Throws InputError for a folder of other settings or with other
/// contents, a live camera, or an unusable model.
EdgeImageCounts write_edge_images(ImageSource& source, const EdgeImageOptions& options);

}  // namespace edgevo
