// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/core/output_file.h"
#include "edgevo/results/run_text.h"
#include "exporters.h"

namespace edgevo {

void export_frames(ExportContext* context, const std::string& path) {
  write_file(path, frames_csv(context->run));
}

void export_covariances(ExportContext* context, const std::string& path) {
  write_file(path, covariances_csv(context->run));
}

void export_graph(ExportContext* context, const std::string& path) {
  write_file(path, graph_csv(context->run));
}

void export_scale(ExportContext* context, const std::string& path) {
  write_file(path, scale_csv(context->run));
}

bool has_scale(const ExportContext& context) { return !context.run.scale.frames.empty(); }

}  // namespace edgevo
