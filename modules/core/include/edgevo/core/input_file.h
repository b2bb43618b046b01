#pragma once
// A whole file as text, with every failure told (missing, a folder, no permission, a read error).
#include <string>

namespace edgevo {

/// The bytes of the file; empty for an empty file. Throws InputError "PATH: cannot be read: REASON; REMEDY".
std::string read_file(const std::string& path, const std::string& remedy);

}  // namespace edgevo
