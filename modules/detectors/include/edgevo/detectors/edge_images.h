#pragma once
// The probability of an edge for every image of a source, as files: for the detector `precomputed`, here or
// on another machine.
//
//   FOLDER/NAME.png           8 bits, 0 to 255, for the image NAME.* of the source, or the frame of that
//                             number (000012)
//   FOLDER/edges.yaml         what they were made of: images of other settings are not added to them
//   FOLDER/contact_sheet.jpg  some frames with their edges, and their probability beside them
#include <functional>
#include <string>

#include "edgevo/core/image_source.h"
#include "edgevo/edges/edge_params.h"

namespace edgevo {

/// What is written, and where.
struct EdgeImageOptions {
  EdgeParams edges;    ///< the detector; of one that looks at the gradient alone, the edge pixels are written
                       ///< (0 or 255)
  std::string folder;  ///< where the files go
  std::string source_path;                 ///< as the user named it, for edges.yaml
  int threads = 1;                         ///< the bytes do not depend on it
  bool force = false;                      ///< the folder may hold something else
  std::function<void(int)> on_frame_done;  ///< frames so far; one call at a time
  std::function<bool()> stop;              ///< asked before each frame
};

/// What became of the images of the source.
struct EdgeImageCounts {
  int written = 0;                                       ///< new files
  int kept = 0;                                          ///< had been there
  int left_out = 0;                                      ///< the source's image could not be used
  int all() const { return written + kept + left_out; }  ///< images of the source
};

/// Reads `source` to its end. Files that are there are kept, and each new one is whole or not there: an
/// interrupted call is gone on with by another. Throws InputError: a folder of other settings or of somebody
/// else, a live camera, a model that cannot be used.
EdgeImageCounts write_edge_images(ImageSource& source, const EdgeImageOptions& options);

}  // namespace edgevo
