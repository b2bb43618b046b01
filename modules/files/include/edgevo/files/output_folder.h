#pragma once
// What stands in the way of an output: the source that it is made from, or what somebody else has put there.
// Commands ask before they write; nothing is changed here.
#include <string>
#include <vector>

namespace edgevo {

/// Throws InputError when `output` lies in `source` or around it, links resolved: writing would change what
/// is read. Of a rawlog the folder of its images counts as well; of a folder, folders that are linked into
/// it. A `source` that is no path (camera:0) is apart from everything.
void check_apart(const std::string& source, const std::string& output);

/// Throws InputError when something is at `path` already, unless `force`.
void check_not_there(const std::string& path, bool force);

/// Throws InputError unless the folder is not there, empty, or holds one of `marks`: names by which a command
/// knows what an earlier call of it has left. With `force`, whatever it holds.
void check_folder_is_ours(const std::string& folder, const std::vector<std::string>& marks, bool force);

/// The names in a folder, sorted; none where there is no such folder.
std::vector<std::string> names_in(const std::string& folder);

}  // namespace edgevo
