// SPDX-License-Identifier: BSD-3-Clause
#include "include_rules.h"

#include <algorithm>
#include <map>
#include <set>
#include <sstream>

namespace edgevo::test {
namespace {

// Siblings that must not use each other, although one is below the other in the list.
const std::set<std::string> kSiblings{"occupancy", "mrpt_bridge", "visp_bridge"};

// Modules that link ViSP and are therefore under the GPL; no other module may link them.
const std::set<std::string> kUnderTheGpl{"visp_bridge", "servo"};

// Headers of libraries by prefix, and the modules that may expose them.
struct Library {
  const char* name;
  std::vector<std::string> prefixes;
  std::set<std::string> owners;
};
const std::vector<Library> kLibraries{
    {"Ceres", {"ceres/"}, {}},  // hidden in one source file
    {"OctoMap", {"octomap/", "octomath/"}, {"occupancy"}},
    {"MRPT", {"mrpt/"}, {"mrpt_bridge"}},
    {"ViSP", {"visp3/", "visp/"}, {"visp_bridge", "servo"}},
    {"OpenCV", {"opencv2/", "opencv/"}, {"edges", "features", "opencv_bridge"}},
};

bool begins_with(const std::string& s, const std::string& prefix) {
  return s.compare(0, prefix.size(), prefix) == 0;
}

// "modules/NAME/..." -> NAME; empty for a file elsewhere.
std::string module_of(const std::string& path) {
  const std::string root = "modules/";
  if (!begins_with(path, root)) return {};
  return path.substr(root.size(), path.find('/', root.size()) - root.size());
}

bool is_public_header(const std::string& path) { return path.find("/include/") != std::string::npos; }

struct Include {
  std::string name;
  int line;
};

std::vector<Include> includes_of(const std::string& text) {
  std::vector<Include> found;
  std::istringstream in(text);
  std::string line;
  for (int number = 1; std::getline(in, line); ++number) {
    line.erase(
        std::remove_if(line.begin(), line.end(), [](char c) { return c == ' ' || c == '\t' || c == '\r'; }),
        line.end());
    if (!begins_with(line, "#include")) continue;
    const size_t open = line.find_first_of("<\""), close = line.find_first_of(">\"", open + 1);
    if (open != std::string::npos && close != std::string::npos)
      found.push_back({line.substr(open + 1, close - open - 1), number});
  }
  return found;
}

// "edgevo/NAME/X.h" -> NAME. Two headers for programs lie above: edgevo/edgevo.h and edgevo/sources.h.
std::string module_used(const std::string& include) {
  if (include == "edgevo/edgevo.h") return "facade";
  if (include == "edgevo/sources.h") return "datasets";
  return include.substr(7, include.find('/', 7) - 7);
}

std::string module_rule(const std::string& user, const Include& include,
                        const std::vector<std::string>& order) {
  if (include.name.find("../") != std::string::npos || begins_with(include.name, "modules/"))
    return "reaches into another folder; include the public header edgevo/MODULE/X.h";
  if (!begins_with(include.name, "edgevo/")) return {};
  const std::string used = module_used(include.name);
  const auto user_at = std::find(order.begin(), order.end(), user),
             used_at = std::find(order.begin(), order.end(), used);
  if (used_at == order.end()) return "is of no module that CMakeLists.txt lists";
  if (used_at > user_at) return "reaches upward: " + user + " stands below " + used;
  if (used != user && kSiblings.count(user) && kSiblings.count(used))
    return "joins siblings: " + user + " and " + used + " do not use each other";
  if (kUnderTheGpl.count(used) && !kUnderTheGpl.count(user))
    return "brings the GPL into " + user + ": what links ViSP stays in visp_bridge and servo";
  return {};
}

std::string library_rule(const std::string& module, const Include& include) {
  for (const Library& library : kLibraries)
    for (const std::string& prefix : library.prefixes)
      if (begins_with(include.name, prefix) && !library.owners.count(module))
        return std::string("shows ") + library.name + " in a public header of " + module +
               ", which does not own it";
  return {};
}

}  // namespace

std::vector<std::string> module_order(const std::string& cmake_lists) {
  const size_t set = cmake_lists.find("set(EDGEVO_MODULES");
  if (set == std::string::npos) return {};
  const size_t begin = set + std::string("set(EDGEVO_MODULES").size();
  std::istringstream names(cmake_lists.substr(begin, cmake_lists.find(')', begin) - begin));
  std::vector<std::string> order;
  for (std::string name; names >> name;) order.push_back(name);
  return order;
}

std::vector<std::string> broken_include_rules(const SourceFile& file, const std::vector<std::string>& order) {
  const std::string module = module_of(file.path);
  std::vector<std::string> broken;
  if (std::find(order.begin(), order.end(), module) == order.end())
    return {file.path + ": lies in no module that CMakeLists.txt lists"};
  for (const Include& include : includes_of(file.text)) {
    std::string rule = module_rule(module, include, order);
    if (rule.empty() && is_public_header(file.path)) rule = library_rule(module, include);
    if (!rule.empty())
      broken.push_back(file.path + ":" + std::to_string(include.line) + ": " + include.name + " " + rule);
  }
  return broken;
}

}  // namespace edgevo::test
