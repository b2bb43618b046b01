// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// COLMAP's database.db, an SQLite database of which the table `cameras` is read
// (colmap.github.io/database.html).
#include <string>

#include "dialect.h"

namespace edgevo {

/// Whether the file is an SQLite database, by its first bytes. False if it cannot be read.
bool is_sqlite_file(const std::string& path);

/// The cameras of a database, which is opened for reading only and not read whole: it may have gigabytes.
/// A camera without a prior focal length has a doubt. Throws InputError.
NamedCameras colmap_database_cameras(const std::string& path);

}  // namespace edgevo
