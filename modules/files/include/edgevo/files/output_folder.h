// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Checks before writing an output: it must not overlap its source or overwrite files of others. Nothing is
// changed here.
#include <string>
#include <vector>

namespace edgevo {

/// Throws InputError if `output` is inside `source` or contains it, with links resolved: writing would change
/// the input. A rawlog includes the folder of its images, and a folder the folders linked into it. A `source`
/// that is not a path (camera:0) overlaps nothing.
void check_apart(const std::string& source, const std::string& output);

/// Throws InputError if `path` exists already, unless `force`.
void check_not_there(const std::string& path, bool force);

/// Throws InputError if the file `path` exists and does not hold `mark`, a text by which a command recognises
/// its own earlier output, among its first 4 kB. Does nothing with `force`.
void check_file_is_ours(const std::string& path, const std::string& mark, bool force);

/// Throws InputError unless the folder does not exist, is empty or contains one of `marks`: file names by
/// which a command recognises its own earlier output. Does nothing with `force`.
void check_folder_is_ours(const std::string& folder, const std::vector<std::string>& marks, bool force);

/// Names in a folder, sorted; empty if the folder does not exist.
std::vector<std::string> names_in(const std::string& folder);

}  // namespace edgevo
