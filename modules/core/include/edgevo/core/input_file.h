// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Reads a whole file as text and reports every failure (missing, a folder, no permission, a read error).
#include <string>

namespace edgevo {

/// Bytes of the file. Throws InputError "PATH: cannot be read: REASON; REMEDY".
std::string read_file(const std::string& path, const std::string& remedy);

/// The same without the byte order mark with which some editors begin a UTF-8 file.
std::string read_text(const std::string& path, const std::string& remedy);

/// Throws the same InputError unless `path` is a regular file of at most 2 GB: not a folder, a device (which
/// may be endless) or a pipe (which may never start).
void check_regular_file(const std::string& path, const std::string& remedy);

}  // namespace edgevo
