// SPDX-License-Identifier: BSD-3-Clause
#include <cstdio>

#include "commands.h"
#include "edgevo/core/output_file.h"
#include "edgevo/map_evaluation/map_figures.h"
#include "edgevo/occupancy/edge_ply_reader.h"

namespace edgevo::app {

int eval_map(const MapEvaluationRequest& request) {
  const Run map = read_edge_ply(request.map);
  const SceneRenderer scene(load_scene(request.scene, request.seed));
  if (!request.picture.empty()) {
    const std::string png = map_picture_png(map, scene, request.picture_frame);  // before a file is there
    OutputFile out(request.picture);
    out.write(png);
    out.close();
  }
  const MapFigures figures = evaluate_map(map, scene);
  if (figures.is_of_another_scene())
    std::fputs("the lines lie at no edges of this scene: it is another one, or its seed or camera is\n",
               stderr);
  std::fputs((request.json ? to_json(figures) : to_table(figures)).c_str(), stdout);
  return 0;
}

}  // namespace edgevo::app
