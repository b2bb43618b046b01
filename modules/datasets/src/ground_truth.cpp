// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/datasets/ground_truth.h"

#include <algorithm>
#include <sstream>
#include <string_view>
#include <vector>

#include "edgevo/core/error.h"
#include "edgevo/datasets/source_folder.h"
#include "layouts/layout.h"
#include "text_file.h"

namespace edgevo {

std::string ground_truth_tum(const SourceOptions& requested, const ImageSource& source) {
  if (const std::string path = source.ground_truth_path(); !path.empty()) return read_text_file(path);
  SourceOptions options = requested;
  options.path = source_folder(requested.path);
  const Layout* layout = layout_of(options.path);
  return layout && layout->ground_truth ? layout->ground_truth(options) : std::string();
}

std::string played_backward(const std::string& tum, Timestamp first, Timestamp last) {
  std::vector<std::string> poses;
  std::istringstream lines(tum);
  for (std::string line; std::getline(lines, line);) {
    if (line.empty() || line[0] == '#') continue;
    const size_t end = line.find(' ');
    Timestamp t;
    if (!parse_seconds(std::string_view(line).substr(0, end), &t))
      throw InputError("ground truth", "has no time in '" + line + "'",
                       "write lines `t tx ty tz qx qy qz qw`");
    t.ticks = first.ticks + last.ticks - t.ticks;
    if (t.ticks >= 0) poses.push_back(to_string(t) + line.substr(std::min(end, line.size())) + '\n');
  }
  std::string text = "# played backward: t tx ty tz qx qy qz qw\n";
  for (auto pose = poses.rbegin(); pose != poses.rend(); ++pose) text += *pose;
  return text;
}

}  // namespace edgevo
