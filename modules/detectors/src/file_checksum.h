// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Checksum of a file, to distinguish it from others of the same name.
#include <string>

namespace edgevo {

/// Returns "NAME, SIZE bytes, fnv1a HEX". Throws InputError if the file cannot be read.
std::string file_checksum(const std::string& path);

}  // namespace edgevo
