#pragma once
// A whole file as text, with every failure told (missing, a folder, no permission, a read error).
#include <string>

namespace edgevo {

/// The bytes of the file; empty for an empty file. Throws InputError "PATH: cannot be read: REASON; REMEDY".
std::string read_file(const std::string& path, const std::string& remedy);

/// Throws the same unless a regular file of at most 2 GB is there: neither a folder, nor a device (which may
/// have no end), nor a pipe (which may never begin).
void check_regular_file(const std::string& path, const std::string& remedy);

}  // namespace edgevo
