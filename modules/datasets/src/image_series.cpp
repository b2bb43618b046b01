// SPDX-License-Identifier: BSD-3-Clause
#include "image_series.h"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <map>
#include <set>

#include "edgevo/core/error.h"
#include "edgevo/files/image_names.h"
#include "edgevo/recordings/recording.h"

namespace edgevo {
namespace {

namespace fs = std::filesystem;

using Names = std::vector<std::string>;

/// The names of each pattern.
using Series = std::map<std::string, Names>;

// With more patterns than these the names are no decimal series: words, or hexadecimal digits.
constexpr size_t kMaxSeries = 8;
// Other names than those of the series are a few odd files up to this share.
constexpr double kOddShare = 0.05;
constexpr size_t kSmallestSeries = 3;

bool is_digit(char c) { return c >= '0' && c <= '9'; }
bool is_letter(char c) { return std::isalpha(static_cast<unsigned char>(c)) != 0; }

std::string lower_case(std::string text) {
  for (char& c : text) c = char(std::tolower(static_cast<unsigned char>(c)));
  return text;
}

bool is_image_name(const fs::path& path) {
  static const std::set<std::string> kKnown{".png", ".jpg", ".jpeg", ".bmp",  ".pgm",
                                            ".ppm", ".tif", ".tiff", ".webp", ".jp2"};
  return path.filename().string().front() != '.' && kKnown.count(lower_case(path.extension().string())) > 0;
}

size_t end_of_number(const std::string& name, size_t at) {
  while (at < name.size() && is_digit(name[at])) ++at;
  return at;
}

// "cam0": the number of a camera, not of an image.
bool numbers_a_camera(const std::string& name, size_t begin, size_t end) {
  constexpr size_t kMaxDigits = 2;
  if (end - begin > kMaxDigits) return false;
  size_t word = begin;
  while (word > 0 && is_letter(name[word - 1])) --word;
  static const std::set<std::string> kCameras{"cam", "camera", "sensor", "view"};
  return kCameras.count(lower_case(name.substr(word, begin - word))) > 0;
}

int numbers_in(const std::string& name) {
  int count = 0;
  for (size_t i = 0; i < name.size(); ++i)
    if (is_digit(name[i]) && (i == 0 || !is_digit(name[i - 1]))) ++count;
  return count;
}

// The first folder below, by name, that holds images; empty if none does.
std::string folder_with_images(const std::string& folder) {
  std::string found;
  std::error_code ignored;
  for (const auto& below : fs::directory_iterator(folder, ignored)) {
    const std::string path = below.path().string();
    if (!below.is_directory(ignored) || (!found.empty() && found < path)) continue;
    for (const auto& entry : fs::directory_iterator(path, ignored))
      if (is_image_name(entry.path())) {
        found = path;
        break;
      }
  }
  return found;
}

// A folder of other sources than images: which of them to give.
[[noreturn]] void throw_without_images(const std::string& folder) {
  std::string file;
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(folder, ignored)) {
    const std::string path = entry.path().string();
    const bool is_source = entry.path().extension() == ".rawlog" || is_recording(path);
    if (is_source && (file.empty() || path < file)) file = path;
  }
  if (!file.empty()) throw InputError(folder, "the folder holds no images", "give a file of it: " + file);
  if (const std::string below = folder_with_images(folder); !below.empty())
    throw InputError(folder, "the folder itself holds no images", "give the one below that does: " + below);
  throw InputError(folder, "the folder holds no images", "put images there (png, jpg, bmp, pgm, ppm, tif)");
}

Names image_names(const std::string& folder) {
  Names names;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(folder, error))
    if (is_image_name(entry.path())) names.push_back(entry.path().filename().string());
  if (error) throw InputError(folder, "the folder cannot be read: " + error.message(), "check the path");
  if (names.empty()) throw_without_images(folder);
  std::sort(names.begin(), names.end(), natural_less);
  return names;
}

Names selected(const Names& names, const std::string& pattern, const std::string& folder) {
  Names kept;
  for (const std::string& name : names)
    if (matches(name, pattern)) kept.push_back(name);
  if (kept.empty())
    throw InputError("--images '" + pattern + "'", "matches none of the images in " + folder,
                     "give a pattern such as '" + pattern_of(names.front()) + "'");
  return kept;
}

std::string without_suffix(const std::string& name) { return fs::path(name).stem().string(); }

// Images of one series may be files of two kinds, unless both have an image of the same name.
Series series_of(const Names& names) {
  std::set<std::string> stems;
  bool twice = false;
  for (const std::string& name : names) twice |= !stems.insert(without_suffix(name)).second;
  Series series;
  for (const std::string& name : names) {
    const std::string pattern = pattern_of(name);
    series[twice ? pattern : without_suffix(pattern) + ".*"].push_back(name);
  }
  if (twice) return series;
  Series named;  // by the suffix, where a series has only one
  for (auto& [pattern, of_pattern] : series) {
    std::set<std::string> patterns;
    for (const std::string& name : of_pattern) patterns.insert(pattern_of(name));
    named[patterns.size() == 1 ? *patterns.begin() : pattern] = std::move(of_pattern);
  }
  return named;
}

// Words in the names of what belongs to an image, but is none.
bool is_next_to_an_image(const std::string& pattern) {
  static const std::set<std::string> kWords{"alpha",     "confidence", "depth",       "depths",  "disp",
                                            "disparity", "flow",       "instance",    "label",   "labels",
                                            "mask",      "masks",      "normal",      "normals", "seg",
                                            "semantic",  "semantics",  "segmentation"};
  std::string word;
  for (const char c : lower_case(pattern) + ".") {
    if (is_letter(c)) {
      word += c;
      continue;
    }
    if (kWords.count(word) > 0) return true;
    word.clear();
  }
  return false;
}

std::string list_of(const Series& series, const std::string& except) {
  std::string text;
  for (const auto& [pattern, names] : series) {
    if (pattern == except) continue;
    text += (text.empty() ? "" : ", ") +
            (names.size() == 1 ? names.front() : pattern + " (" + std::to_string(names.size()) + ")");
  }
  return text;
}

// The only series of images, if all others are masks and the like; empty if there is no such series.
std::string only_images(const Series& series) {
  std::string found;
  for (const auto& entry : series) {
    if (is_next_to_an_image(entry.first)) continue;
    if (!found.empty()) return {};
    found = entry.first;
  }
  return found;
}

std::string largest(const Series& series) {
  return std::max_element(series.begin(), series.end(),
                          [](const auto& a, const auto& b) { return a.second.size() < b.second.size(); })
      ->first;
}

// Length of what all names begin with, up to a digit.
size_t common_beginning(const Names& names) {
  size_t length = names.front().size();
  for (const std::string& name : names) {
    const auto end = names.front().begin() + long(std::min(length, name.size()));
    length = size_t(std::mismatch(names.front().begin(), end, name.begin()).first - names.front().begin());
  }
  while (length > 0 && is_digit(names.front()[length - 1])) --length;
  return length;
}

// The names in the order of the hexadecimal number in which alone they differ; empty if there is none that
// counts images: words such as "face" are numbers far from each other.
Names by_hexadecimal_number(const Names& names) {
  constexpr size_t kMaxDigits = 15;
  constexpr uint64_t kApart = 4;  // mean difference of numbers that count: every fourth image is there
  const size_t begin = common_beginning(names);
  std::map<uint64_t, std::string> by_number;
  std::set<std::string> ends;
  bool has_digits = false;
  for (const std::string& name : names) {
    size_t end = begin;
    while (end < name.size() && std::isxdigit(static_cast<unsigned char>(name[end]))) ++end;
    if (end == begin || end - begin > kMaxDigits) return {};
    by_number[std::stoull(name.substr(begin, end - begin), nullptr, 16)] = name;
    ends.insert(name.substr(end));
    has_digits |= std::any_of(name.begin() + long(begin), name.begin() + long(end), is_digit);
  }
  const bool counts =
      by_number.rbegin()->first - by_number.begin()->first <= kApart * uint64_t(by_number.size());
  if (!has_digits || ends.size() > 1 || by_number.size() < names.size() || !counts) return {};
  Names sorted;
  for (const auto& [number, name] : by_number) sorted.push_back(name);
  return sorted;
}

// Names that count nothing in decimal digits: a few words, or hexadecimal digits.
bool has_no_series(const Series& series) {
  return series.size() > kMaxSeries || series.at(largest(series)).size() < kSmallestSeries;
}

// `any`: the caller needs no sequence, and takes all images rather than none.
Names only_series(const Names& all, const std::string& folder, bool any, Decisions* decisions) {
  const Series series = series_of(all);
  if (series.size() == 1) return all;
  const auto decide = [&](const InputDecision& decision) {
    if (decisions) decisions->push_back(decision);
  };
  if (Names sorted = has_no_series(series) ? by_hexadecimal_number(all) : Names(); !sorted.empty()) {
    decide({"order", "all " + std::to_string(all.size()) + " images by their hexadecimal numbers",
            "as they count the images", ""});
    return sorted;
  }
  if (has_no_series(series)) {
    decide(
        {"order", "all " + std::to_string(all.size()) + " images by their names",
         "the names are not of one pattern",
         any ? "" : "an order that is not that of time mixes up the path; number the images, or list them"});
    return all;
  }
  if (const std::string images = only_images(series); !images.empty()) {
    decide({"order", images, "left out: " + list_of(series, images), ""});
    return series.at(images);
  }
  const std::string main = largest(series);
  if (any) {
    decide({"order", "all " + std::to_string(all.size()) + " images by their names",
            "several series: " + list_of(series, ""),
            "a run takes one series; choose one, as with --images '" + main + "'"});
    return all;
  }
  if (double(all.size() - series.at(main).size()) <= kOddShare * double(all.size())) {
    decide({"order", main, "left out: " + list_of(series, main),
            "the names are not of one pattern; --images '*' takes all images"});
    return series.at(main);
  }
  throw InputError(folder, "the images are of several series: " + list_of(series, ""),
                   "choose one, as with --images '" + main + "'; '*' takes all by their names");
}

}  // namespace

std::string pattern_of(const std::string& name) {
  const bool has_several = numbers_in(without_suffix(name)) > 1;
  std::string pattern;
  for (size_t i = 0; i < name.size();) {
    const size_t end = end_of_number(name, i);
    if (end == i)
      pattern += name[i++];
    else if (has_several && numbers_a_camera(name, i, end))
      pattern += name.substr(i, end - i), i = end;
    else
      pattern += '#', i = end;
  }
  return pattern;
}

bool matches(const std::string& name, const std::string& pattern) {
  std::vector<bool> matched(name.size() + 1);  // which prefixes of `name` the pattern so far matches
  matched[0] = true;
  for (const char p : pattern) {
    std::vector<bool> next(name.size() + 1);
    next[0] = p == '*' && matched[0];
    for (size_t i = 0; i < name.size(); ++i) {
      if (p == '*')
        next[i + 1] = matched[i + 1] || next[i];
      else if (p == '#')
        next[i + 1] = (matched[i] || next[i]) && is_digit(name[i]);
      else
        next[i + 1] = matched[i] && (p == '?' || p == name[i]);
    }
    matched = std::move(next);
  }
  return matched[name.size()];
}

std::vector<std::string> list_images(const std::string& folder, const SourceOptions& options,
                                     Decisions* decisions) {
  Names names = image_names(folder);
  if (!options.images.empty())
    names = selected(names, options.images, folder);
  else
    names = only_series(names, folder, options.any_camera, decisions);
  for (std::string& name : names) name = (fs::path(folder) / name).string();
  return names;
}

}  // namespace edgevo
