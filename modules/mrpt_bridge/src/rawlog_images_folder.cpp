// SPDX-License-Identifier: BSD-3-Clause
#include "rawlog_images_folder.h"

#include <filesystem>

#include "edgevo/core/error.h"
#include "edgevo/mrpt_bridge/rawlog_writer.h"

namespace edgevo {

namespace fs = std::filesystem;

std::string find_images_folder(const std::string& rawlog_path) {
  const std::string stem = rawlog_stem(rawlog_path);
  const fs::path parent = fs::path(rawlog_path).parent_path();
  std::error_code ignored;
  for (const fs::path& folder : {fs::path(stem + "_Images"), fs::path(stem + "_images"),
                                 fs::path(stem + "_IMAGES"), parent / "Images"})
    if (fs::is_directory(folder, ignored)) return folder.string();
  throw InputError(rawlog_path,
                   "its images are stored externally, but there is no folder " + stem + "_Images",
                   "put the folder of images next to the rawlog under that name");
}

}  // namespace edgevo
