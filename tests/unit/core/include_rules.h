#pragma once
// The include rules of the project, as a function of the text of a file: which module may use which, and
// which library's headers may stand in whose public headers.
#include <string>
#include <vector>

namespace edgevo::test {

/// One source file, by its path from the source folder: "modules/edges/src/gradient.cpp".
struct SourceFile {
  std::string path;
  std::string text;
};

/// The names of the modules, bottom to top, as CMakeLists.txt lists them (EDGEVO_MODULES). Empty if it does
/// not.
std::vector<std::string> module_order(const std::string& cmake_lists);

/// What the file's includes break, one sentence each; empty if nothing.
///   - A module uses only modules below it; bridges and occupancy are siblings that do not use each other.
///   - What links ViSP (GPL) is used by nothing else: visp_bridge by servo only, servo by no module.
///   - A library's headers stand in the public headers of its owner only.
///   - "edgevo/..." headers of another module must be public ones; no "../" and no path into another module's
///     src.
std::vector<std::string> broken_include_rules(const SourceFile& file, const std::vector<std::string>& order);

}  // namespace edgevo::test
