// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The page of `edgevo eval OUT/edges.ply SCENE --page FILE`.
#include <string>

#include "edgevo/map_evaluation/map_figures.h"

namespace edgevo::app {

/// What the page is about.
struct MapPage {
  const Run& map;
  const SceneRenderer& scene;
  const MapFigures& figures;
  /// Names of both.
  std::string map_name, scene_name;
};

/// A page with all figures and with pictures of six frames, evenly spread.
std::string map_page_html(const MapPage& page);

}  // namespace edgevo::app
