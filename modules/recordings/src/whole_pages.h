// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// SQLite's access to a file that does not change, as if a page that was cut off were not there: SQLite itself
// fills such a page with zeros, which would show as pixels.

namespace edgevo {

/// Name of the access ("VFS") for sqlite3_open_v2(), registered by the first call.
const char* whole_pages_vfs();

}  // namespace edgevo
