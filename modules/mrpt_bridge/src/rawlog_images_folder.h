#pragma once
#include <string>

namespace edgevo {

/// The folder with the external images of a rawlog; throws InputError naming the places looked at if there is
/// none.
std::string find_images_folder(const std::string& rawlog_path);

}  // namespace edgevo
