#pragma once
// Where the running program lies: what is built or installed beside it is found from there, wherever that is.
#include <filesystem>

namespace edgevo {

/// The folder of the program's own file, links followed; empty where the system does not tell (no /proc).
std::filesystem::path program_folder();

/// The folder share/edgevo of the build or the installation that the running program is of, whether that lies
/// in bin/ or in libexec/edgevo/.
std::filesystem::path data_folder();

/// The same for a program in `folder`: the share/edgevo of the nearest folder above that has one; where none
/// has, what would be that of the folder just above.
std::filesystem::path data_folder_of(const std::filesystem::path& folder);

}  // namespace edgevo
