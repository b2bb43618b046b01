#pragma once
// The surveys of an archive in the layout of Symphony Lake.
#include <string>
#include <vector>

namespace edgevo {

struct Survey {
  std::string name, folder;
};

/// All surveys below an archive's folder, by name; none where it is no archive. Cost: a look at each folder
/// of the archive's trees.
std::vector<Survey> surveys_in(const std::string& archive);

}  // namespace edgevo
