// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The include rules of the project, as a function of the text of a file: which module may use which, and
// which library's headers may appear in whose public headers.
#include <string>
#include <vector>

namespace edgevo::test {

/// One source file, by its path from the source folder: "modules/edges/src/gradient.cpp".
struct SourceFile {
  std::string path;
  std::string text;
};

/// Names of the modules, bottom to top, as CMakeLists.txt lists them (EDGEVO_MODULES); empty without a list.
std::vector<std::string> module_order(const std::string& cmake_lists);

/// Violations by the file's includes, one sentence each.
///   - A module uses only modules below it; bridges and occupancy are siblings that do not use each other.
///   - Modules that link ViSP (GPL) are not used by others: visp_bridge by servo only, servo by no module.
///   - A library's headers appear only in the public headers of its owner.
///   - "edgevo/..." headers of another module must be public ones; no "../" and no path into another module's
///     src.
std::vector<std::string> broken_include_rules(const SourceFile& file, const std::vector<std::string>& order);

}  // namespace edgevo::test
