// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/results/compared_runs.h"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <set>

#include "edgevo/core/error.h"
#include "edgevo/results/finished_run.h"

namespace edgevo {
namespace {

namespace fs = std::filesystem;

fs::path plain(const std::string& path) {
  const fs::path normal = fs::absolute(path).lexically_normal();
  return normal.has_filename() ? normal : normal.parent_path();  // "out/" is "out"
}

std::vector<std::string> folders_of(const std::vector<std::string>& paths) {
  std::vector<std::string> folders;
  std::set<fs::path> known;
  for (const std::string& path : paths)
    for (const std::string& folder : find_runs(path))
      if (known.insert(plain(folder)).second) folders.push_back(folder);
  return folders;
}

// The deepest folder that contains all `folders`.
fs::path common_parent(const std::vector<std::string>& folders) {
  fs::path common = plain(folders.front()).parent_path();
  const auto holds = [&](const std::string& folder) {
    const fs::path path = plain(folder).parent_path();
    return std::mismatch(common.begin(), common.end(), path.begin(), path.end()).first == common.end();
  };
  while (common.has_relative_path() && !std::all_of(folders.begin(), folders.end(), holds))
    common = common.parent_path();
  return common;
}

// `path` as a URL: reserved and non-ASCII characters as %XX.
std::string url_of(const std::string& path) {
  static const char* const kHex = "0123456789ABCDEF";
  const std::string plain_characters = "-._~/";
  std::string url;
  for (const char c : path) {
    const auto byte = static_cast<unsigned char>(c);
    if ((byte < 0x80 && std::isalnum(byte)) || plain_characters.find(c) != std::string::npos)
      url += c;
    else
      url += {'%', kHex[byte >> 4], kHex[byte & 15]};
  }
  return url;
}

ComparedRun row_of(const FinishedRun& run, const fs::path& common, const fs::path& page_folder) {
  ComparedRun row;
  row.name = plain(run.folder).lexically_relative(common).string();
  row.problem = run.problem;
  row.source = run.source;
  if (!run.report.empty()) row.link = url_of(plain(run.report).lexically_relative(page_folder).string());
  row.ground_truth = run.ground_truth;
  row.frames = run.frames, row.lost = run.lost, row.keyframes = run.keyframes, row.segments = run.segments;
  row.cpu_ms = run.cpu_ms;
  row.trajectory = run.trajectory;
  return row;
}

}  // namespace

std::vector<ComparedRun> compared_runs(const std::vector<std::string>& paths, const std::string& ground_truth,
                                       const std::string& page) {
  if (!ground_truth.empty()) read_trajectory(ground_truth);
  const std::vector<std::string> folders = folders_of(paths);
  const fs::path common = common_parent(folders);
  std::vector<ComparedRun> rows;
  for (const std::string& folder : folders) {
    rows.push_back(row_of(read_finished_run(folder), common, plain(page).parent_path()));
    if (!ground_truth.empty()) rows.back().ground_truth = ground_truth;
  }
  const bool any =
      std::any_of(rows.begin(), rows.end(), [](const ComparedRun& r) { return r.problem.empty(); });
  if (!any) throw InputError(rows.front().name, "cannot be compared: " + rows.front().problem, "");
  return rows;
}

}  // namespace edgevo
