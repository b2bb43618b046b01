// SPDX-License-Identifier: BSD-3-Clause
#include <cstdio>

#include "commands.h"
#include "edgevo/core/output_file.h"
#include "edgevo/map_evaluation/map_figures.h"
#include "edgevo/occupancy/edge_ply_reader.h"
#include "map_page.h"

namespace edgevo::app {
namespace {

void write_file(const std::string& path, const std::string& bytes) {
  OutputFile out(path);
  out.write(bytes);
  out.close();
}

}  // namespace

int eval_map(const MapEvaluationRequest& request) {
  const Run map = read_edge_ply(request.map);
  const SceneRenderer scene(load_scene(request.scene, request.seed));
  if (!request.picture.empty())
    write_file(request.picture, map_picture_png(map, scene, request.picture_frame));
  MapEvaluationOptions options;
  options.why = request.why || !request.page.empty();
  const MapFigures figures = evaluate_map(map, scene, options);
  if (figures.is_of_another_scene())
    std::fputs("the lines lie at no edges of this scene: it is another one, or its seed or camera is\n",
               stderr);
  if (!request.page.empty())
    write_file(request.page, map_page_html({map, scene, figures, request.map, request.scene}));
  std::fputs((request.json ? to_json(figures) : to_table(figures)).c_str(), stdout);
  return 0;
}

}  // namespace edgevo::app
