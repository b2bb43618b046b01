// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The known folder layouts. A new one needs a file layout_NAME.cpp next to this one, its declaration here and
// a line in layout_list.cpp.
#include <string>

#include "edgevo/datasets/open_source.h"
#include "sequence.h"

namespace edgevo {

struct Layout {
  bool (*recognises)(const std::string& folder);
  Sequence (*read)(const SourceOptions& options);
  /// True if the layout's cameras have names to select by (--sensor).
  bool has_labels;
  /// Ground truth that is stored with the images in a format other than TUM's, as TUM text (ground_truth.h);
  /// empty if there is none. nullptr: the layout has none but Sequence::ground_truth_path.
  std::string (*ground_truth)(const SourceOptions& options);
  /// True if the images are those of a folder, from which --images selects; false if a list names them.
  bool lists_folder = false;
  /// True if the layout states times; false if they follow from a rate.
  bool has_times = true;
};

/// The first layout that recognises the folder; nullptr if none does or it is not a folder.
const Layout* layout_of(const std::string& folder);

Layout edgevo_layout();
Layout kitti_layout();
Layout tum_layout();
Layout euroc_layout();
Layout virtual_kitti_layout();
Layout symphony_layout();
Layout davis_layout();

/// Reads the list `name` of a folder, one time and one file below the folder a line, into images and times.
/// Throws InputError.
void read_times_and_names(const SourceOptions& options, const std::string& name, Sequence* sequence);

/// Reads a folder of images that has none of the layouts.
Sequence read_image_folder(const SourceOptions& options);

}  // namespace edgevo
