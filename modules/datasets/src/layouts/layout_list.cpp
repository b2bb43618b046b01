// SPDX-License-Identifier: BSD-3-Clause
#include <filesystem>

#include "layout.h"

namespace edgevo {

const Layout* layout_of(const std::string& folder) {
  // In the order in which they are tried.
  static const Layout kLayouts[] = {
      davis_layout(), edgevo_layout(),        kitti_layout(),    tum_layout(),
      euroc_layout(), virtual_kitti_layout(), symphony_layout(),
  };
  std::error_code ignored;
  if (!std::filesystem::is_directory(folder, ignored)) return nullptr;
  for (const Layout& layout : kLayouts)
    if (layout.recognises(folder)) return &layout;
  return nullptr;
}

}  // namespace edgevo
