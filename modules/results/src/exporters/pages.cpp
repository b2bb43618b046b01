// SPDX-License-Identifier: BSD-3-Clause
#include <opencv2/imgcodecs.hpp>

#include "edgevo/core/output_file.h"
#include "edgevo/report/run_report.h"
#include "exporters.h"
#include "summary/summary.h"

namespace edgevo {
namespace {

// Vertices in the order of edges.ply: points, then lines.
std::vector<MapVertex> map_vertices(const Run& run, const PointFilter& points) {
  std::vector<MapVertex> vertices = map_points(run, points), lines = map_lines(run);
  vertices.insert(vertices.end(), lines.begin(), lines.end());
  return vertices;
}

}  // namespace

void export_report(ExportContext* context, const std::string& path) {
  constexpr int kPictures = 6, kDoubtful = 3;
  const auto image_path = [&](int frame) { return context->playback->image_path(frame); };
  const PointFilter& points = context->params.occupancy.points;
  const EdgePictures pictures =
      draw_edge_pictures(context->run, *context->camera, points, image_path, kPictures);
  const EdgePictures doubtful =
      draw_doubtful_pictures(context->run, *context->camera, points, image_path, kDoubtful);
  write_file(path, report_html({context->run, *context->info, points, pictures, context->not_written,
                                context->map, map_vertices(context->run, points), doubtful}));
}

void export_ego_mask(ExportContext* context, const std::string& path) {
  const GrayImage& mask = context->info->ego_mask;
  const cv::Mat view(mask.height, mask.width, CV_8U, const_cast<uint8_t*>(mask.pixels.data()));
  std::vector<uint8_t> bytes;
  cv::imencode(".png", view, bytes);
  write_file(path, {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
}

bool has_ego_mask(const ExportContext& context) { return context.info && !context.info->ego_mask.empty(); }

void export_found_camera(ExportContext* context, const std::string& path) {
  write_file(path, context->info->camera_file);
}

bool has_found_camera(const ExportContext& context) {
  return context.info && !context.info->camera_file.empty();
}

void export_summary(ExportContext* context, const std::string& path) {
  const ResourceUse use_with_outputs = context->meter->so_far();
  write_file(path, summary_yaml({context->run, *context->info, context->use_of_run, use_with_outputs,
                                 context->map, context->not_written}));
}

}  // namespace edgevo
