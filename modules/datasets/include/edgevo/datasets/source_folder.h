#pragma once
// A SOURCE that is named by an archive and what it holds, as the folder that it is.
#include <string>

namespace edgevo {

/// Where the files of SOURCE lie: `path` itself, but of ARCHIVE/SURVEY of Symphony Lake, and of an archive
/// with a single survey, the survey's folder. open_source() and ground_truth_tum() ask by themselves. Throws
/// InputError: an archive with several surveys (it lists them), two of one name, none of that name.
std::string source_folder(const std::string& path);

}  // namespace edgevo
