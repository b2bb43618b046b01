// SPDX-License-Identifier: BSD-3-Clause
#include "octree_file.h"

#include <sstream>

namespace edgevo {

std::string octree_header(const char* first_line, const std::string& comments,
                          const octomap::AbstractOcTree& tree) {
  std::ostringstream out;
  out.precision(10);  // the resolution must read back as it is
  out << first_line << "\n# (feel free to add / change comments, but leave the first line as it is!)\n"
      << comments << "#\nid " << tree.getTreeType() << "\nsize " << tree.size() << "\nres "
      << tree.getResolution() << "\ndata\n";
  return out.str();
}

std::string octree_comments(const Run& run) {
  return "# edges of edgevo; axes: x forward, y left, z up\n# unit: " + unit_statement(run) + "\n";
}

}  // namespace edgevo
