// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Resolves a SOURCE given as an archive and one of its surveys to a folder.
#include <string>

namespace edgevo {

/// Folder of the files of SOURCE: the survey's folder for ARCHIVE/SURVEY of Symphony Lake and for an archive
/// with a single survey, else `path` itself. open_source() and ground_truth_tum() call this themselves.
/// Throws InputError: an archive with several surveys (it lists them), two of the same name, none of that
/// name.
std::string source_folder(const std::string& path);

}  // namespace edgevo
