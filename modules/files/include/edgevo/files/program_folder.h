#pragma once
// Where the running program lies: what is built or installed beside it is found from there, wherever that is.
#include <filesystem>

namespace edgevo {

/// The folder of the program's own file, links followed; empty where the system does not tell (no /proc).
std::filesystem::path program_folder();

}  // namespace edgevo
