// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/mrpt_bridge/scene_writer.h"
#include "edgevo/mrpt_bridge/simplemap_writer.h"
#include "exporters.h"

namespace edgevo {

void export_simplemap(ExportContext* context, const std::string& path) {
  write_simplemap(context->run, context->params.occupancy.points, path);
}

void export_scene(ExportContext* context, const std::string& path) {
  write_scene(context->run, context->params.occupancy.points, path);
}

void export_playback(ExportContext* context, const std::string&) {
  context->playback->finish(context->run, context->params.occupancy.points);
}

}  // namespace edgevo
