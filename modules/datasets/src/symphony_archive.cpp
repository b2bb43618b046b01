// SPDX-License-Identifier: BSD-3-Clause
#include "symphony_archive.h"

#include <algorithm>
#include <filesystem>
#include <tuple>

#include "edgevo/core/error.h"
#include "edgevo/symphony_lake/survey_geometry.h"
#include "sequence.h"

namespace edgevo {
namespace {

namespace fs = std::filesystem;

constexpr int kLevelsOfArchive = 3;  // ARCHIVE/Dataset/20YY/SURVEY

bool is_survey(const fs::path& folder) {
  return !existing((folder / symphony::kSurveyList).string()).empty();
}

bool is_year(const fs::path& folder) {
  const std::string name = folder.filename().string();
  return name.size() == 4 && name.rfind("20", 0) == 0;
}

std::vector<fs::path> folders_in(const fs::path& folder) {
  std::vector<fs::path> found;
  std::error_code error, ignored;
  fs::directory_iterator entry(folder, error), end;
  for (; !error && entry != end; entry.increment(error))
    if (entry->is_directory(ignored)) found.push_back(entry->path());
  return found;
}

void add_surveys(const fs::path& tree, std::vector<Survey>* surveys) {
  for (const fs::path& folder : folders_in(tree)) {
    if (is_survey(folder)) surveys->push_back({folder.filename().string(), folder.string()});
    if (!is_year(folder)) continue;
    for (const fs::path& inner : folders_in(folder))
      if (is_survey(inner)) surveys->push_back({inner.filename().string(), inner.string()});
  }
}

// "140106, 140117, ... (130 in all)".
std::string listed(const std::vector<Survey>& surveys) {
  constexpr size_t kShown = 20;  // more fill the screen
  std::string text;
  for (size_t i = 0; i < std::min(kShown, surveys.size()); ++i)
    text += (i == 0 ? "" : ", ") + surveys[i].name;
  return surveys.size() <= kShown ? text : text + ", ... (" + std::to_string(surveys.size()) + " in all)";
}

[[noreturn]] void throw_two_of_one_name(const std::string& path, const Survey& a, const Survey& b) {
  throw InputError(path, "there are two surveys named " + a.name + ": " + a.folder + " and " + b.folder,
                   "give the path of one of these folders");
}

std::string only_survey(const std::string& archive, const std::vector<Survey>& surveys) {
  if (surveys.size() == 1) return surveys.front().folder;
  if (surveys.front().name == surveys.back().name) throw_two_of_one_name(archive, surveys[0], surveys[1]);
  throw InputError(archive, "holds " + std::to_string(surveys.size()) + " surveys: " + listed(surveys),
                   "name one of them, such as " + (fs::path(archive) / surveys.front().name).string());
}

std::string survey_of_name(const std::string& path, const std::string& name,
                           const std::vector<Survey>& surveys) {
  std::vector<Survey> found;
  std::vector<std::string> names;
  for (const Survey& survey : surveys) {
    names.push_back(survey.name);
    if (survey.name == name) found.push_back(survey);
  }
  if (found.size() > 1) throw_two_of_one_name(path, found[0], found[1]);
  if (found.empty())
    throw InputError(path, "the archive has no survey '" + name + "'",
                     "did you mean " + nearest_name(name, names) + "?");
  return found.front().folder;
}

// Absolute, without a slash at its end.
fs::path absolute(const std::string& path) {
  std::error_code ignored;
  const fs::path whole = fs::weakly_canonical(fs::absolute(path, ignored), ignored);
  return whole.has_filename() ? whole : whole.parent_path();
}

}  // namespace

std::vector<Survey> surveys_in(const std::string& archive) {
  std::vector<Survey> surveys;
  for (const fs::path& tree : {fs::path(archive), fs::path(archive) / "VBags", fs::path(archive) / "Dataset"})
    add_surveys(tree, &surveys);
  std::sort(surveys.begin(), surveys.end(), [](const Survey& a, const Survey& b) {
    return std::tie(a.name, a.folder) < std::tie(b.name, b.folder);
  });
  return surveys;
}

std::string survey_folder(const std::string& path) {
  std::error_code ignored;
  if (fs::is_directory(path, ignored)) {
    const std::vector<Survey> surveys = is_survey(path) ? std::vector<Survey>() : surveys_in(path);
    return surveys.empty() ? path : only_survey(path, surveys);
  }
  if (path.empty() || fs::exists(fs::symlink_status(path, ignored))) return path;
  const fs::path whole = absolute(path);
  const std::vector<Survey> surveys = surveys_in(whole.parent_path().string());
  return surveys.empty() ? path : survey_of_name(path, whole.filename().string(), surveys);
}

std::string survey_map(const std::string& survey_folder) {
  const fs::path folder = absolute(survey_folder);
  fs::path above = folder.parent_path();
  for (int level = 0; level < kLevelsOfArchive; ++level, above = above.parent_path()) {
    const std::string found = existing((above / "Maps" / folder.filename() / "optposes.csv").string());
    if (!found.empty()) return found;
  }
  return {};
}

std::string survey_name(const std::string& survey_folder) {
  return absolute(survey_folder).filename().string();
}

}  // namespace edgevo
