#pragma once
// What a file held, to be told apart from another of the same name.
#include <string>

namespace edgevo {

/// "NAME, SIZE bytes, fnv1a HEX". Throws InputError when it cannot be read.
std::string file_checksum(const std::string& path);

}  // namespace edgevo
