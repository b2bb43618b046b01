// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/files/output_folder.h"

#include <algorithm>
#include <filesystem>
#include <fstream>

#include "edgevo/core/error.h"

namespace edgevo {
namespace {

namespace fs = std::filesystem;

// Path without links, dots and a trailing slash.
fs::path resolved(const fs::path& path) {
  std::error_code error;
  const fs::path absolute = fs::absolute(path, error);
  fs::path whole = fs::weakly_canonical(absolute, error);
  if (error) whole = absolute.lexically_normal();  // a name too long, a folder without permission
  return whole.has_filename() ? whole : whole.parent_path();
}

bool is_within(const fs::path& inner, const fs::path& outer) {
  const auto [end, _] = std::mismatch(outer.begin(), outer.end(), inner.begin(), inner.end());
  return end == outer.end();
}

// Targets of links in `folder` and in the folders directly in it (mav0/cam0).
void add_linked_folders(const fs::path& folder, std::vector<fs::path>* folders) {
  std::error_code error;
  fs::recursive_directory_iterator entry(folder, fs::directory_options::skip_permission_denied, error), end;
  for (; !error && entry != end; entry.increment(error)) {
    if (entry.depth() >= 1) entry.disable_recursion_pending();
    if (entry->is_symlink(error) && entry->is_directory(error)) folders->push_back(resolved(entry->path()));
  }
}

// MRPT's names for the folder of a rawlog's images.
void add_image_folders(const fs::path& rawlog, std::vector<fs::path>* folders) {
  const std::string stem = (rawlog.parent_path() / rawlog.stem()).string();
  std::error_code ignored;
  for (const char* suffix : {"_Images", "_images", "_IMAGES"})
    if (fs::exists(stem + suffix, ignored)) folders->push_back(resolved(stem + suffix));
}

std::vector<fs::path> folders_of(const std::string& source) {
  std::vector<fs::path> folders{resolved(source)};
  std::error_code ignored;
  if (fs::is_directory(source, ignored)) add_linked_folders(source, &folders);
  if (fs::path(source).extension() == ".rawlog") add_image_folders(source, &folders);
  return folders;
}

}  // namespace

void check_apart(const std::string& source, const std::string& output) {
  std::error_code ignored;
  if (source.empty() || !fs::exists(source, ignored)) return;
  const fs::path out = resolved(output);
  for (const fs::path& folder : folders_of(source)) {
    const bool inside = is_within(out, folder), around = is_within(folder, out);
    if (!inside && !around) continue;
    const std::string how = inside && around ? "is" : inside ? "lies inside" : "holds";
    throw InputError(output, how + " its own source " + source + ", which writing would change",
                     "give a folder outside the source");
  }
}

void check_not_there(const std::string& path, bool force) {
  std::error_code ignored;
  if (force || !fs::exists(fs::symlink_status(path, ignored))) return;
  throw InputError(path, "exists already", "give another name, or --force to write over it");
}

void check_file_is_ours(const std::string& path, const std::string& mark, bool force) {
  std::error_code ignored;
  if (force || !fs::is_regular_file(path, ignored)) return;
  std::string begin(4096, '\0');
  std::ifstream file(path, std::ios::binary);
  file.read(begin.data(), std::streamsize(begin.size()));
  begin.resize(size_t(file.gcount()));
  if (begin.empty() || begin.find(mark) != std::string::npos) return;
  throw InputError(path, "exists already and is something else",
                   "give another name, or --force to write over it");
}

void check_folder_is_ours(const std::string& folder, const std::vector<std::string>& marks, bool force) {
  const std::vector<std::string> names = names_in(folder);
  const auto is_there = [&](const std::string& mark) {
    return std::binary_search(names.begin(), names.end(), mark);
  };
  if (force || names.empty() || std::any_of(marks.begin(), marks.end(), is_there)) return;
  throw InputError(folder,
                   "contains other files already (" + names.front() + (names.size() > 1 ? ", ..." : "") + ")",
                   "give another -o, or --force to write there anyway");
}

std::vector<std::string> names_in(const std::string& folder) {
  std::vector<std::string> names;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(folder, error))
    names.push_back(entry.path().filename().string());
  std::sort(names.begin(), names.end());
  return names;
}

}  // namespace edgevo
