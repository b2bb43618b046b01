// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The surveys of an archive in the layout of Symphony Lake.
#include <string>
#include <vector>

namespace edgevo {

/// A survey in an archive.
struct Survey {
  /// Name (its date), and folder of its list and images.
  std::string name, folder;
};

/// All surveys below an archive's folder, by name; empty if it is not an archive. Cost: one look at each
/// folder of the archive's trees.
std::vector<Survey> surveys_in(const std::string& archive);

}  // namespace edgevo
