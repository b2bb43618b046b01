#pragma once
// The folder layouts that there are. A new one: a file layout_NAME.cpp beside this one, its declaration here
// and its line in layout_list.cpp.
#include <string>

#include "edgevo/datasets/open_source.h"
#include "sequence.h"

namespace edgevo {

struct Layout {
  bool (*recognises)(const std::string& folder);
  Sequence (*read)(const SourceOptions& options);
  bool has_labels;  ///< its cameras have names to choose by (--sensor)
  /// Ground truth that stands beside the images in another format than TUM's, as TUM text (ground_truth.h);
  /// empty if there is none. nullptr: such a layout has none but Sequence::ground_truth_path.
  std::string (*ground_truth)(const SourceOptions& options);
};

/// The first that recognises the folder; nullptr: it is none of them, or no folder.
const Layout* layout_of(const std::string& folder);

Layout edgevo_layout();
Layout kitti_layout();
Layout tum_layout();
Layout euroc_layout();
Layout virtual_kitti_layout();
Layout symphony_layout();

/// A folder of images that is none of them.
Sequence read_image_folder(const SourceOptions& options);

}  // namespace edgevo
