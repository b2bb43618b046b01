// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <string>

namespace edgevo {

/// Folder of a rawlog's external images. Throws InputError naming the folders searched if there is none.
std::string find_images_folder(const std::string& rawlog_path);

}  // namespace edgevo
